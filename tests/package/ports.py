#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the vcpkg port and the Conan recipe with stand-ins for what those programs bring, and configures goffer with the
options that they come to; builds and runs what Conan would test the package with. Neither program is needed.
   ports.py TOP FOLDER PREFIX
PREFIX: where goffer is installed, as the package that the recipe makes would be."""
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import types

TOP, WORK, PREFIX = map(pathlib.Path, sys.argv[1:])
PORT = TOP / "engine/packaging/vcpkg/goffer"
VERSION = re.search(r"project\(goffer VERSION ([\d.]+)", (TOP / "CMakeLists.txt").read_text()).group(1)

VCPKG = """cmake_minimum_required(VERSION 3.25)
function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES")
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature option)
    message("feature ${feature}")
    set(value OFF)
    if(feature IN_LIST FEATURES)
      set(value ON)
    endif()
    list(APPEND options -D${option}=${value})
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  foreach(option IN LISTS arg_OPTIONS)
    message("option ${option}")
  endforeach()
  message("source ${arg_SOURCE_PATH}")
endfunction()
foreach(name IN ITEMS vcpkg_cmake_install vcpkg_cmake_config_fixup vcpkg_fixup_pkgconfig vcpkg_copy_tools vcpkg_copy_pdbs
                      vcpkg_install_copyright)
  cmake_language(EVAL CODE "function(${name})\\nendfunction()")
endforeach()
set(CURRENT_PACKAGES_DIR packages-that-are-not-there)
"""


def configure(name, options):
    """Configures goffer, which must know every option and find what it needs."""
    ran = subprocess.run(["cmake", "-S", TOP, "-B", WORK / name, *options], capture_output=True, text=True, check=False)
    print(name, *options)
    if ran.returncode != 0 or "not used by the project" in ran.stderr:
        sys.exit(f"{name}: {ran.stdout}{ran.stderr}")


def vcpkg(features):
    """The options that the port comes to, and the features that it knows."""
    script = WORK / "port.cmake"
    script.write_text(f'{VCPKG}set(FEATURES {";".join(features)})\ninclude("{PORT}/portfile.cmake")\n')
    said = subprocess.run(["cmake", "-P", script], capture_output=True, text=True, check=True).stderr
    assert pathlib.Path(re.search("source (.*)", said).group(1)) == TOP, said
    return re.findall("option (.*)", said), set(re.findall("feature (.*)", said))


class Recorder:
    """Stands for any class of Conan's."""

    def __init__(self, *_):
        self.cache_variables = {}
        made.append(self)

    def generate(self):
        """Writes nothing."""


class Builder:
    """Stands for Conan's CMake: builds a recipe's project in its folder for programs."""

    def __init__(self, recipe):
        self.source, self.binary = recipe.recipe_folder, recipe.cpp.build.bindir

    def configure(self):
        """Finds goffer as CMakeDeps would have it found."""
        subprocess.run(["cmake", "-S", self.source, "-B", self.binary, "-DCMAKE_BUILD_TYPE=Release",
                        f"-DCMAKE_PREFIX_PATH={PREFIX}"], check=True)

    def build(self):
        """All of it."""
        subprocess.run(["cmake", "--build", self.binary], check=True)


def recipe_of(path, name, cmake):
    """A recipe of Conan's, and the module that it comes from. `cmake` stands for its class CMake."""
    conanfile = types.SimpleNamespace(ConanFile=object)
    tools = {"conan": conanfile, "conan.tools": types.SimpleNamespace(),
             "conan.tools.build": types.SimpleNamespace(check_min_cppstd=None, can_run=lambda _: True),
             "conan.tools.cmake": types.SimpleNamespace(CMake=cmake, CMakeDeps=Recorder, CMakeToolchain=Recorder,
                                                        cmake_layout=None),
             "conan.tools.files": types.SimpleNamespace(copy=None, load=lambda _, file: pathlib.Path(file).read_text())}
    sys.modules.update(tools)
    spec = importlib.util.spec_from_file_location("recipe", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    recipe = getattr(module, name)()
    recipe.recipe_folder = str(path.parent)
    return recipe, module


def conan_test():
    """Builds and runs what `conan create` tests the package with."""
    recipe, _ = recipe_of(TOP / "engine/packaging/conan/test_package/conanfile.py", "GofferTest", Builder)
    recipe.cpp = types.SimpleNamespace(build=types.SimpleNamespace(bindir=str(WORK / "conan test")))
    recipe.tested_reference_str = f"goffer/{VERSION}"
    needed = []
    recipe.requires = needed.append
    recipe.run = lambda program, **_: subprocess.run([program], check=True)
    recipe.requirements()
    assert needed == [recipe.tested_reference_str], needed
    recipe.build()
    recipe.test()


def conan(chosen):
    """The options that the recipe comes to."""
    recipe, module = recipe_of(TOP / "engine/packaging/conan/conanfile.py", "Goffer", Recorder)
    recipe.options = types.SimpleNamespace(**{**module.Goffer.default_options, **chosen})
    needed = []
    recipe.requires = lambda name, **_: needed.append(name)
    recipe.set_version()
    assert recipe.version == VERSION, recipe.version
    recipe.requirements()
    recipe.generate()
    variables = next(one.cache_variables for one in made if one.cache_variables)
    made.clear()
    return [f"-D{name}={'ON' if value else 'OFF'}" for name, value in variables.items()], needed


made = []
WORK.mkdir(parents=True, exist_ok=True)
manifest = json.loads((PORT / "vcpkg.json").read_text())
assert manifest["version"] == VERSION, manifest["version"]
for features in (["tbb"], ["tbb", "offline", "tools"], []):
    options, known = vcpkg(features)
    assert known == set(manifest["features"]), known
    configure(f"vcpkg {'+'.join(features)}", options)
for chosen in ({}, {"offline": True}, {"tbb": False}):
    options, needed = conan(chosen)
    assert all("include_prerelease" in name for name in needed if "-" in name.partition("/")[2]), needed
    assert any("onetbb" in name for name in needed) == chosen.get("tbb", True), needed
    configure(f"conan {chosen}".replace("'", ""), options)
conan_test()
