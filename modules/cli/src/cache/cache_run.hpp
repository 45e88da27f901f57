// SPDX-License-Identifier: MIT
#pragma once

#include "cache/cache.hpp"
#include "cache/cast.hpp"

#include <goffer/bend/body.hpp>

#include <memory>
#include <string>
#include <vector>

namespace goffer::cli {

/// All that shards are made from, read and understood before anything is written.
class CacheRun {
public:
    /// Throws an error that names what is at fault: the scene, a file that it names, the folder or its plan.
    explicit CacheRun(const CacheRequest& request);

    /// Writes the bodies and the plan, where they are not there; removes a manifest of another plan.
    void set_up() const;

    [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
    [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
    [[nodiscard]] const Cast& cast() const noexcept { return *cast_; }

private:
    struct NewFile {
        std::string name, bytes;
    };

    void choose(const CacheRequest& request);
    void load_bodies(const CacheRequest& request);

    std::filesystem::path folder_;
    Scene scene_;
    std::optional<Plan> before_;  ///< as the folder has it
    Plan plan_;
    std::vector<bend::Body> bodies_;
    std::vector<NewFile> new_files_;
    std::unique_ptr<Cast> cast_;
};

}  // namespace goffer::cli
