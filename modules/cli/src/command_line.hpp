// SPDX-License-Identifier: MIT
#pragma once

/// The names of CLI11 that headers need. Only what defines or reads words includes <CLI/CLI.hpp>, which takes
/// a compiler four seconds each time.

namespace CLI {

class App;
class Option;
class ParseError;
class Validator;

}  // namespace CLI
