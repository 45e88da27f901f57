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

    /// How the plan differs from the one that the folder has; empty where it has none or the same.
    [[nodiscard]] std::vector<std::string> changes() const;

    /// Throws InputError where a file that shards are made from is not as it was when its checksum was taken.
    void check_unchanged() const;

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

    /// How a file can be told from what it was, without reading it.
    struct Stamp {
        std::filesystem::path file;
        std::uintmax_t bytes;
        std::filesystem::file_time_type modified;
    };
    [[nodiscard]] static Stamp stamp_of(const std::filesystem::path& file);

    std::filesystem::path folder_;
    std::vector<Stamp> stamps_;  // of the scene and all that it names
    Scene scene_;
    std::optional<Plan> before_;  ///< as the folder has it
    Plan plan_;
    std::vector<bend::Body> bodies_;
    std::vector<NewFile> new_files_;
    std::unique_ptr<Cast> cast_;
};

}  // namespace goffer::cli
