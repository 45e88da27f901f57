# A port of the tree that it lies in: vcpkg install goffer --overlay-ports=engine/packaging/vcpkg --no-binarycaching
# (vcpkg's cache goes by the port alone, and would not see that the sources have changed.)
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES
  tbb     GOFFER_TBB
  offline GOFFER_OFFLINE
  tools   GOFFER_TOOLS)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DGOFFER_TESTS=OFF -DGOFFER_BENCH=OFF -DGOFFER_SAMPLES=OFF -DGOFFER_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/goffer)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES goffer AUTO_CLEAN)
endif()
vcpkg_copy_pdbs()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
