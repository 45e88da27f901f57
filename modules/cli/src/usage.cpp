// SPDX-License-Identifier: MIT
#include "usage.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <vector>

namespace goffer::cli {
namespace {

/// How many letters are to be put in, left out or replaced to make one word of the other (Levenshtein).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (const char letter : a) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (letter == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// "; did you mean WORD?" for the one of `words` that begins so, or else the nearest; empty if none is near.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& words) {
    const auto longer = std::ranges::find_if(
        words, [&](const std::string& word) { return wrong.size() > 3 && word.starts_with(wrong); });
    if (longer != words.end()) return "; did you mean " + *longer + "?";
    std::string nearest;
    std::size_t least = wrong.size() / 3 + 2;
    for (const std::string& word : words) {
        const std::size_t off = distance(wrong, word);
        if (off < least) {
            least = off;
            nearest = word;
        }
    }
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// An option that has another option's name for its value, since its own was left out; or nothing.
std::string option_as_value(const CLI::App& command) {
    std::vector<std::string> names = names_of_options(command);
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& value : option->results()) {
            if (std::ranges::count(names, value) != 0)
                return option->get_name() + " needs a value; " + value + " is an option";
        }
    }
    return "";
}

/// What is wrong with words that a command leaves over: an unknown option, one without its value, or else too
/// many names.
std::string fault_of_rest(const CLI::App& command, const std::vector<std::string>& rest) {
    const auto option =
        std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with("-"); });
    if (option == rest.end()) return "'" + rest.front() + "' is a word too many";
    const std::string name = option->substr(0, option->find('='));
    return "there is no option " + name + suggestion(name, names_of_options(command));
}

/// What is wrong with how often an option is given, or how many values it has.
std::string fault_of_count(const CLI::App& command, const std::string& fault) {
    const CLI::Option* const option = command.get_option_no_throw(fault.substr(0, fault.find(':')));
    if (option == nullptr || option->count() <= 1) return " needs a value";
    const int most = option->get_expected_max();
    return most > 1 ? " are more than " + std::to_string(most) + "; give fewer"
                    : " is given more than once; give it once";
}

/// The subcommand that was given, or null.
const CLI::App* command_of(const CLI::App& app) {
    const std::vector<const CLI::App*> commands =
        app.get_subcommands([](const CLI::App* command) { return command->parsed(); });
    return commands.empty() ? nullptr : commands.front();
}

std::string see_help(const CLI::App& command) {
    return "; see goffer " + command.get_name() + " --help";
}

}  // namespace

std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
    const std::string help = "; see goffer --help";
    const std::vector<std::string> before = app.remaining(false), rest = app.remaining(true);
    if (!before.empty()) {
        const std::string& word = before.front();
        if (word.starts_with("-")) return "there is no option " + word + " before a command" + help;
        return "there is no command " + word + suggestion(word, names_of_commands(app)) + help;
    }
    const CLI::App* const given = command_of(app);
    if (given == nullptr) return "give a command: " + CLI::detail::join(names_of_commands(app), ", ") + help;
    const CLI::App& command = *given;
    if (const std::string taken = option_as_value(command); !taken.empty()) return taken + see_help(command);
    std::string fault = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && !rest.empty()) fault = fault_of_rest(command, rest);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
        fault = fault.substr(0, fault.find(':')) + fault_of_count(command, fault);
    return fault + see_help(command);
}

std::string fault_of_values(const CLI::App& app) {
    const CLI::App* const command = command_of(app);
    if (command == nullptr) return "";
    if (const std::string taken = option_as_value(*command); !taken.empty())
        return taken + see_help(*command);
    for (const CLI::Option* option : command->get_options()) {
        if (option->get_expected_min() == 0) continue;  // it goes without a value, too
        if (std::ranges::count(option->results(), "") != 0)
            return "the value of " + option->get_name() + " is empty" + see_help(*command);
    }
    return "";
}

}  // namespace goffer::cli
