// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body.hpp>
#include <goffer/bend/path.hpp>
#include <goffer/bend/pose.hpp>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

/// Paths that bodies lie and walk on.

namespace goffer::cli {

/// A path as it is said.
struct PathWords {
    std::vector<glm::dvec3> points;  ///< two or more; of Bezier curves, four for each
    bool closed = false;             ///< it goes back to its beginning
    bool smooth = true;              ///< a curve runs through the points, rather than straight pieces
    bool bezier = false;
};

/// The path that a document says: points as arrays of three numbers, or an object with "points" or "bezier",
/// "closed" and "curve". `scale` multiplies all of it. `where` begins errors. Throws InputError.
[[nodiscard]] PathWords read_path(const nlohmann::json& document, double scale, const std::string& where);

/// A path as bodies follow it: a polyline, fine where it stands for a curve, by its length. Along it a frame
/// is carried without twist, so that a body that walks on it does not roll; on a closed path, what the frame
/// is turned by after a round is spread over the round. Immutable and thread-safe.
class Path {
public:
    /// Throws InputError, which `where` begins, if all points are the same.
    Path(const PathWords& words, const std::string& where);

    [[nodiscard]] double length() const noexcept { return along_.back(); }
    [[nodiscard]] bool closed() const noexcept { return closed_; }

    /// bend::poses_along() with the base end's center `start` from the beginning: an open path goes
    /// straight on beyond its ends, a closed one goes round. In PathFit::transform the body has the roll of
    /// the frame.
    [[nodiscard]] bend::PathFit lay(const bend::Body& body, double start, std::span<bend::Pose> poses) const;

private:
    [[nodiscard]] std::vector<glm::vec3> window(double start, double length) const;
    [[nodiscard]] std::size_t piece_at(double along) const;
    [[nodiscard]] glm::dvec3 point_at(double along) const;

    std::vector<glm::dvec3> points_;    // no two neighbors are equal
    std::vector<double> along_;         // of each point
    std::vector<glm::dvec3> headings_;  // of each piece, unit length
    std::vector<glm::dquat> turns_;     // of the frame, from the first piece to each
    double twist_ = 0;                  // of a closed path: what its frame is turned by after a round
    bool closed_ = false;
};

}  // namespace goffer::cli
