// SPDX-License-Identifier: MIT
#pragma once

#include "support/commands.hpp"
#include "support/files.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

namespace goffer::test {

/// A folder to run commands in.
class CommandFolder {
public:
    /// Runs the command `goffer`, which must succeed.
    void goffer(const std::string& words) const {
        REQUIRE(std::system((in_folder() + "'" GOFFER_COMMAND "' " + words + " >/dev/null 2>&1").c_str()) ==
                0);
    }

    /// What `program` prints on both outputs.
    [[nodiscard]] std::string output(const std::string& program, const std::string& words) const {
        return output_of(in_folder() + "'" + program + "' " + words + " 2>&1");
    }

private:
    [[nodiscard]] std::string in_folder() const { return "cd '" + (folder_ / ".").string() + "' && "; }

    Folder folder_;
};

}  // namespace goffer::test
