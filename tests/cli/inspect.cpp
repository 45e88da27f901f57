// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>

using namespace goffer;
using namespace goffer::test;
using nlohmann::json;

namespace {

glm::dvec3 vector(const json& value) {
    REQUIRE(value.is_array());
    REQUIRE(value.size() == 3);
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

void check_vector(const json& value, const glm::dvec3& truth, double tolerance) {
    CAPTURE(value.dump());
    CHECK(glm::length(vector(value) - truth) <= tolerance);
}

}  // namespace

TEST_CASE("inspect: every field, with its type") {
    const Folder folder;
    const json all = report(folder, {"inspect", base(folder)});
    CHECK(all["file"] == "base.ply");
    for (const std::string count : {"vertices", "triangles", "primitives", "folds_capacity"}) {
        CAPTURE(count);
        CHECK(all[count].is_number_integer());
    }
    CHECK(all["vertices"] == 10304);
    CHECK(all["triangles"] == 20480);
    CHECK(all["primitives"] == 1);
    CHECK(all["folds_capacity"] == 20);
    CHECK(all["folds"] == 20);
    CHECK(all["warnings"] == json::array());
    CHECK(all["max_angle"].is_number_float());
    CHECK(all["area"].get<double>() == doctest::Approx(2 * 3.14159265 * 10).epsilon(1e-3));
    for (const std::string number : {"length", "radius", "rest_angle", "rest_direction", "residual"}) {
        CAPTURE(number);
        CHECK(all["fit"][number].is_number_float());
    }
}

TEST_CASE("inspect: the base cylinder is found") {
    const Folder folder;
    const json fit = report(folder, {"inspect", base(folder)})["fit"];
    check_vector(fit["origin"], {0, 0, 0}, 1e-6);
    check_vector(fit["axis"], {0, 0, 1}, 1e-7);
    check_vector(fit["zero"], {1, 0, 0}, 1e-7);
    CHECK(std::abs(fit["length"].get<double>() - 10) < 1e-6);
    CHECK(std::abs(fit["radius"].get<double>() - 1) < 1e-6);
    CHECK(fit["rest_angle"] == 0.0);
    CHECK(fit["residual"].get<double>() < 2e-6);
}

TEST_CASE("inspect: the largest angle is in degrees") {
    const Folder folder;
    // Without a wrinkle L / alpha - r > rho_max: alpha < L / (2 r), 286 degrees. The wrinkle needs some more.
    const double angle = report(folder, {"inspect", base(folder)})["max_angle"];
    CHECK(angle < 286.5);
    CHECK(angle > 180);
}

TEST_CASE("inspect: --json - keeps standard output pure, the lines go to standard error") {
    const Folder folder;
    const Result result = run(folder, {"inspect", base(folder), "--json", "-"});
    CHECK(run(folder, {"inspect", base(folder), "--json", "/dev/stdout"}).out == result.out);
    CHECK(result.code == 0);
    CHECK(json::accept(result.out));
    CHECK(result.err.find("largest angle") != result.err.npos);
    CHECK(result.err.find('\r') == result.err.npos);
}

TEST_CASE("inspect: --json writes a file, the lines go to standard output") {
    const Folder folder;
    base(folder);
    const std::string lines = well(folder, {"inspect", "base.ply", "--json", "r.json"});
    CHECK(lines.find("largest angle") != lines.npos);
    CHECK(json::parse(bytes_of(folder / "r.json")) == report(folder, {"inspect", "base.ply"}));
    CHECK(folder.files() == 2);
}

TEST_CASE("inspect: --axis names the direction from base to tip") {
    const Folder folder;
    base(folder);
    const auto fit = [&](const std::string& axis) {
        return report(folder, {"inspect", "base.ply", "--axis", axis})["fit"];
    };
    for (const std::string axis : {"auto", "z", "+z", "0,0,1", "0,0,2e-3"}) {
        CAPTURE(axis);
        check_vector(fit(axis)["axis"], {0, 0, 1}, 1e-4);
        check_vector(fit(axis)["origin"], {0, 0, 0}, 1e-3);
    }
    for (const std::string axis : {"-z", "0,0,-1", "-0,0,-3.5"}) {
        CAPTURE(axis);
        check_vector(fit(axis)["axis"], {0, 0, -1}, 1e-4);
        check_vector(fit(axis)["origin"], {0, 0, 10}, 1e-3);
    }
    check_vector(fit("x")["axis"], {1, 0, 0}, 1e-9);
    check_vector(fit("-y")["axis"], {0, -1, 0}, 1e-9);
    check_vector(fit("1,1,0")["axis"], {std::sqrt(0.5), std::sqrt(0.5), 0}, 1e-9);
    CHECK(fit("x")["length"].get<double>() == doctest::Approx(2));
}

TEST_CASE("inspect: any unit") {
    const Folder folder;
    for (const std::string exponent : {"-11", "-6", "-3", "3", "6", "11"}) {
        CAPTURE(exponent);
        const std::string long_one = std::string("8e") + exponent, thin = std::string("0.5e") + exponent;
        base(folder, "b.ply", {"--length", long_one, "--radius", thin});
        const json fit = report(folder, {"inspect", "b.ply"})["fit"];
        CHECK(std::abs(fit["length"].get<double>() / std::stod(long_one) - 1) < 1e-6);
        CHECK(std::abs(fit["radius"].get<double>() / std::stod(thin) - 1) < 1e-6);
    }
}

TEST_CASE("inspect: beyond the working range is said") {
    const Folder folder;
    for (const std::string exponent : {"-20", "17"}) {
        CAPTURE(exponent);
        base(folder, "b.ply", {"--length", "8e" + exponent, "--radius", "0.5e" + exponent});
        refused(folder, 1, {"inspect", "b.ply"}, {"1e-12"});
    }
}

TEST_CASE("inspect: --rest tells the arc that a body is bent along") {
    const Folder folder;
    base(folder);
    well(folder,
         {"bend", "base.ply", "--angle", "70", "--direction", "30", "--amplitude", "none", "-o", "bent.ply"});
    const json bent = report(folder, {"inspect", "bent.ply", "--rest", "auto", "--axis", "z"});
    CHECK(std::abs(bent["fit"]["rest_angle"].get<double>() - 70) < 1e-4);
    CHECK(bent["fit"]["rest_direction"].is_number_float());
    CHECK(std::abs(bent["fit"]["length"].get<double>() - 10) < 1e-5);
    check_vector(bent["fit"]["origin"], {0, 0, 0}, 2e-6);
    CHECK(bent["rest"]["bent"] == true);
    CHECK(std::abs(bent["rest"]["arc_radius"].get<double>() - (10 / 1.2217305 - 1)) < 1e-5);
    CHECK(bent["rest"]["residual"] == bent["fit"]["residual"]);
    CHECK(bent["rest"]["residual_straight"].get<double>() > 0.5);
    CHECK(bent["fit"]["residual"].get<double>() < 2e-6);
    const std::string lines = well(folder, {"inspect", "bent.ply", "--rest", "auto"});
    CHECK(lines.find("bent by 70") != lines.npos);

    const json straight = report(folder, {"inspect", "bent.ply", "--rest", "straight", "--axis", "z"});
    CHECK(straight["fit"]["rest_angle"] == 0.0);
    CHECK_FALSE(straight.contains("rest"));
    const json cylinder = report(folder, {"inspect", "base.ply", "--rest", "auto"});
    CHECK(cylinder["rest"]["bent"] == false);
    CHECK(cylinder["rest"]["arc_radius"].is_null());
    CHECK(cylinder["fit"]["rest_angle"] == 0.0);
    CHECK(run(folder, {"inspect", "base.ply", "--rest", "curly"}).code == 2);
}

TEST_CASE("inspect: says whether bend adds vertices") {
    const Folder folder;
    base(folder);
    base(folder, "coarse.ply", {"--columns", "12", "--rows", "5"});
    for (const Words& words : {Words{"base.ply"}, Words{"coarse.ply"}, Words{"base.ply", "--arcs", "3"},
                               Words{"coarse.ply", "--arcs", "2"}}) {
        CAPTURE(words.back());
        const json found = report(folder, Words{"inspect"} + words);
        const json bent = report(folder, Words{"bend"} + words);
        CHECK(found["adds_vertices"] == bent.contains("refined"));
        const Result result = run(folder, Words{"inspect"} + words);
        CHECK((result.out.find("goffer bend adds vertices") != std::string::npos) ==
              bent.contains("refined"));
        for (const json& region : bent["regions"]) CHECK(region["folds"] <= region["folds_capacity"]);
    }
    CHECK(report(folder, {"inspect", "coarse.ply"})["adds_vertices"] == true);
    CHECK(report(folder, {"inspect", "base.ply"})["adds_vertices"] == false);
}
