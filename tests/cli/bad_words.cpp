// SPDX-License-Identifier: MIT
#include "command.hpp"

#include <doctest/doctest.h>

/// Wrong usage: exit code 2, one line, nothing written.

using namespace goffer::test;

namespace {

/// A model and one of every output, to be left as they are.
struct KeptOutputs {
    Folder folder;

    KeptOutputs() {
        base(folder);
        for (const std::string name : {"out.ply", "out.png", "out.json"}) folder.write(name, "kept");
    }

    void refuse_bend(const Words& words, const Words& pieces) const {
        refused(folder, 2, Words{"bend", "base.ply", "-o", "out.ply"} + words, pieces);
    }
};

}  // namespace

TEST_CASE("bad words: angles") {
    const KeptOutputs place;
    for (const std::string option : {"--angle", "--direction"}) {
        for (const std::string word : {"nan", "inf", "-inf", "1e400", "abc", "", "90deg", "9 0"}) {
            place.refuse_bend({option, word}, {option, std::string("'") + word + "'", "degrees"});
        }
    }
    place.refuse_bend({"--direction", "max"}, {"--direction", "'max'"});
    place.refuse_bend({"--angle"}, {"--angle"});
    place.refuse_bend({"--angle", "1", "--angle", "2"}, {"--angle"});
}

TEST_CASE("bad words: axes") {
    const KeptOutputs place;
    for (const std::string word : {"0,0,0", "nan,0,1", "inf,0,0"}) {
        place.refuse_bend({"--axis", word}, {"--axis", word, "three finite numbers"});
        refused(place.folder, 2, {"inspect", "base.ply", "--axis", word}, {"--axis", word});
    }
    for (const std::string word : {"0,0,1e-300", "0,1e-200,1e300"})  // whose squares are beyond double
        CHECK(run(place.folder, {"inspect", "base.ply", "--axis", word}).code == 0);
    for (const std::string word : {"1,2", "1,2,3,4", "1,,2", "foo", "", "xy", "--", "1 2 3"}) {
        place.refuse_bend({std::string("--axis=") + word}, {"--axis"});
        refused(place.folder, 2, {"inspect", "base.ply", std::string("--axis=") + word}, {"--axis"});
    }
}

TEST_CASE("bad words: numbers and names out of range") {
    const KeptOutputs place;
    for (const std::string word : {"513", "-1", "2.5", "many", ""})
        place.refuse_bend({"--folds", word}, {"--folds"});
    for (const std::string word : {"-1", "1025", "x"}) place.refuse_bend({"--threads", word}, {"--threads"});
    place.refuse_bend({"--amplitude", "wavy"}, {"--amplitude", "wavy", "paper", "area", "mesh", "none"});
    place.refuse_bend({"--amplitude", "area", "--onset", "0.1"}, {"--amplitude area", "--onset", "mesh"});
    place.refuse_bend({"--amplitude", "area", "--wrinkle-range", "0.1,0.8"}, {"--amplitude area", "mesh"});
    place.refuse_bend({"--profile", "round"}, {"--profile", "round", "even", "damped", "smooth"});
    for (const std::string word : {"0", "-1", "nan", "11", "long", ""})
        place.refuse_bend({"--fold-length", word}, {"--fold-length", "radii", "0.05..10"});
    for (const std::string word : {"0.6", "-0.1", "nan", "round", ""})
        place.refuse_bend({"--roundness", word}, {"--roundness", "0..0.5"});
    for (const std::string profile : {"damped", "smooth"})
        place.refuse_bend({"--profile", profile, "--roundness", "0.25"}, {"--roundness", profile});
    place.refuse_bend({"--paper", "--roundness", "0.1"}, {"--paper", "--roundness"});
    for (const std::string word :
         {"0.8,0.1", "0.5", "0,0.5,1", "-0.1,1", "0,1.1", "0.5,0.5", "nan,1", "", "a,b"})
        place.refuse_bend({"--wrinkle-range", word}, {"--wrinkle-range"});
    for (const std::string word : {"r", "COLOR_0", "COLOR_0.x", "COLOR_0.rg", "COLOR_1.r", "color_0.r"})
        place.refuse_bend({"--wrinkle-mask", word}, {"--wrinkle-mask", "COLOR_0.r"});
    place.refuse_bend({"--shape", "round"}, {"--shape", "round", "auto", "cylinder"});
    place.refuse_bend({"--refine", "maybe"}, {"--refine", "maybe", "auto", "on", "off"});
    place.refuse_bend({"--refine", "base.ply"}, {"base.ply", "a MODEL goes before --refine"});
    place.refuse_bend({"--isa", "mmx"}, {"--isa", "mmx", "scalar"});
}

TEST_CASE("bad words: what does not go together") {
    const KeptOutputs place;
    refused(place.folder, 2, {"bend", "base.ply", "-o", "a.obj", "--json", "a.mtl"},
            {"--json", "a.mtl", "materials"});
    place.refuse_bend({"--ghost"}, {"--ghost", "--png"});
    place.refuse_bend({"--size", "100x100"}, {"--size", "--png"});
    place.refuse_bend({"--camera", "side"}, {"--camera", "--png"});
    for (const char* const size :
         {"100", "x", "100x", "x100", "0x100", "100x16385", "1e2x100", "100x100x3", "-1x5"})
        place.refuse_bend({"--png", "out.png", "--size", size},
                          {"--size: '" + std::string(size) + "' is not a size", "WIDTHxHEIGHT"});
    for (const char* const camera : {"above", "10", "0,91", "0,-90.5", "1,2,3", "a,b", "0,nan"})
        place.refuse_bend({"--png", "out.png", "--camera", camera}, {"--camera: '"});
    place.refuse_bend({"--axis", "z", "--fit", "fit.json"}, {"--axis", "--fit"});
    place.refuse_bend({"--paper", "--profile", "even"}, {"--profile", "--paper"});
    place.refuse_bend({"--paper", "--shape", "cylinder"}, {"--shape", "--paper"});
    place.refuse_bend({"--paper", "--amplitude", "paper"}, {"--amplitude", "--paper"});
}

TEST_CASE("bad words: no or another command, unknown options, too many words") {
    const KeptOutputs place;
    refused(place.folder, 2, {},
            {"give a command: base, inspect, refine, bend, animate, bake, crowd, cache, figures, view; see "
             "goffer --help"});
    refused(place.folder, 2, {"fold", "base.ply"}, {"no command fold", "see goffer --help"});
    refused(place.folder, 2, {"bend"}, {"required"});
    refused(place.folder, 2, {"bent", "base.ply"}, {"no command bent; did you mean bend?"});
    refused(place.folder, 2, {"--angle", "3", "bend"},
            {"no option --angle before a command", "see goffer --help"});
    const Words bend{"bend", "base.ply", "-o", "out.ply"};
    refused(place.folder, 2, bend + Words{"--angel", "40"},
            {"no option --angel; did you mean --angle?", "see goffer bend --help"});
    refused(place.folder, 2, bend + Words{"--fold=3"}, {"no option --fold; did you mean --folds?"});
    refused(place.folder, 2, {"bend", "base.ply", "--angle"},
            {"--angle needs a value; see goffer bend --help"});
    refused(place.folder, 2, bend + Words{"-o", "other.ply"},
            {"--output is given more than once; give it once; see goffer bend --help"});
    for (const std::string option : {"--json", "--png", "--fit", "--path"})
        refused(place.folder, 2, bend + Words{option, ""},
                {"the value of " + option + " is empty; see goffer bend --help"});
    refused(place.folder, 2, {"inspect", ""}, {"the value of model is empty"});
    refused(place.folder, 2, {"bend", "base.ply", "-o", ""}, {"the value of --output is empty"});
    refused(place.folder, 2, {"animate", "base.ply", "-o", "out.glb", "--swing", "1e30"},
            {"--swing: 1e+30 is not an angle in degrees, within 1e+06, or max"});
    refused(place.folder, 2, bend + Words{"--xyzzy"}, {"no option --xyzzy; see goffer bend --help"});
    refused(place.folder, 2, bend + Words{"other.ply"},
            {"'other.ply' is a word too many; see goffer bend --help"});
    refused(place.folder, 2, bend + Words{"--png", "--angle", "40"},
            {"--png needs a value; --angle is an option; see goffer bend --help"});
    refused(place.folder, 2, {"animate", "base.ply", "--swing", "-o", "out.glb"},
            {"--swing needs a value; -o is an option; see goffer animate --help"});
    refused(place.folder, 2, {"bend", "base.ply", "--json", "-o"}, {"--json needs a value; -o is an option"});
    refused(place.folder, 2, bend + Words{"--json", "--ghost"},
            {"--json needs a value; --ghost is an option"});
    refused(place.folder, 2, bend + Words{"--threads", "--ghost"},
            {"--threads needs a value; --ghost is an option"});
    refused(place.folder, 2, bend + Words{"--ang", "4"}, {"did you mean --angle?"});
    refused(place.folder, 2, {"bend", "base.ply"}, {"give -o, --png or --json; see goffer bend --help"});
    refused(place.folder, 2, {"inspect"}, {"model is required"});
    refused(place.folder, 2, {"base"}, {"--output is required"});
    refused(place.folder, 2, {"inspect", "base.ply", "other.ply"}, {"other.ply"});
    place.refuse_bend({"--wave"}, {"--wave"});
}

#ifdef GOFFER_HAS_VIEWER
TEST_CASE("bad words: of a viewer, before it looks for a display") {
    const KeptOutputs place;
    refused(place.folder, 2, {"view", "--size", "10"}, {"--size: '10' is not a size; give WIDTHxHEIGHT"});
    refused(place.folder, 2, {"view", "--json", "out.json"}, {"--json: ", "add --frames N"});
    refused(place.folder, 2, {"view", "--crowd", "-3"}, {"--crowd"});
    refused(place.folder, 2, {"view", "--frames", "0"}, {"--frames"});
}
#endif

TEST_CASE("bad words: endings") {
    const KeptOutputs place;
    for (const std::string name : {"out", "out.xyz", ".ply.", "out.fbx"}) {
        refused(place.folder, 2, {"bend", "base.ply", "-o", name}, {"-o: ", name, ".glb"});
    }
    place.refuse_bend({"--png", "out.jpg"}, {"--png", "out.jpg", ".png"});
}

TEST_CASE("bad words: an output in the place of another file of the command") {
    const KeptOutputs place;
    std::filesystem::create_symlink("base.ply", place.folder / "link.ply");
    std::filesystem::create_directory(place.folder / "sub");
    place.folder.write("fit.json", "{}");
    for (const std::string name : {"base.ply", "./base.ply", "sub/../base.ply", "link.ply"}) {
        refused(place.folder, 2, {"bend", "base.ply", "-o", name}, {"-o", name, "MODEL"});
        refused(place.folder, 2, {"inspect", "base.ply", "--json", name}, {"--json", name, "MODEL"});
    }
    place.refuse_bend({"--json", "base.ply"}, {"--json", "base.ply", "MODEL"});
    place.refuse_bend({"--json", "out.ply"}, {"--json", "out.ply", "-o"});
    place.refuse_bend({"--json", "new.png", "--png", "sub/../new.png"}, {"new.png", "--png", "--json"});
    place.refuse_bend({"--json", "fit.json", "--fit", "fit.json"}, {"--json", "fit.json", "--fit"});
    refused(place.folder, 2, {"base", "-o", "new.ply", "--json", "new.ply"}, {"--json", "new.ply", "-o"});
}
