# SPDX-License-Identifier: MIT
"""A recipe for the tree that it lies in: conan create engine/packaging/conan"""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

TOP = os.path.join("..", "..", "..")


class Goffer(ConanFile):
    name = "goffer"
    description = "Soft-body crowd deformer: bends roughly cylindrical meshes, wrinkles and all"
    license = "MIT"
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "tbb": [True, False], "offline": [True, False]}
    default_options = {"shared": False, "fPIC": True, "tbb": True, "offline": False}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        project = load(self, os.path.join(self.recipe_folder, TOP, "CMakeLists.txt"))
        self.version = re.search(r"project\(goffer VERSION ([\d.]+)", project).group(1)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "engine/*", "modules/*"):
            copy(self, pattern, os.path.join(self.recipe_folder, TOP), self.export_sources_folder)

    def requirements(self):
        self.requires("glm/[>=0.9.9]", transitive_headers=True)
        self.requires("xsimd/[>=8.1]")
        if self.options.tbb:
            self.requires("onetbb/[>=2021.8]")
        if self.options.offline:
            self.requires("eigen/[>=3.4]")
            self.requires("nlohmann_json/[>=3.11]")
            self.requires("tinyobjloader/[>=2.0.0-rc10, include_prerelease]")

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        variables = toolchain.cache_variables
        variables["GOFFER_TBB"] = bool(self.options.tbb)
        variables["GOFFER_OFFLINE"] = bool(self.options.offline)
        variables["GOFFER_INSTALL"] = True
        for part in ("GOFFER_TOOLS", "GOFFER_TESTS", "GOFFER_BENCH", "GOFFER_SAMPLES"):
            variables[part] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # Programs find it by its own package: find_package(goffer).
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "goffer")]
