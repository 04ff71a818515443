# OpenVDB's headers take longer to read than most of our files take to compile: read once, for all.
#
# Its maps (openvdb/math/Maps.h, 10.0) declare virtual functions that they define as inline only after the class. Such a
# function is the class's key function, so every file that reads the header emits six classes whole: 1.3 s of 1.8 s that
# an empty file takes. What is precompiled is a copy that says `inline` in the class too; a header of another version
# that has no such lines stays as it is.
find_path(OPENVDB_HEADERS openvdb/math/Maps.h HINTS ${OpenVDB_INCLUDE_DIR} REQUIRED)
file(READ ${OPENVDB_HEADERS}/openvdb/math/Maps.h maps)
string(REGEX REPLACE
  "\n    (MapBase::Ptr (pre|post)(Translate|Scale)\\(const Vec3d& ?v?\\) const override;)" "\n    inline \\1" maps "${maps}")
string(REGEX REPLACE "#include \"([A-Za-z0-9]+\\.h)\"" "#include <openvdb/math/\\1>" maps "${maps}")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/openvdb_maps.h CONTENT "${maps}" @ONLY)

# Its own grids are compiled once, too.
add_library(openvdb_grids STATIC
  cmake/openvdb/float_grid.cpp
  cmake/openvdb/int_grid.cpp
  cmake/openvdb/mask_grid.cpp
  cmake/openvdb/vec_grid.cpp
)
target_link_libraries(openvdb_grids PRIVATE fluidtex_flags OpenVDB::openvdb)
target_precompile_headers(openvdb_grids PRIVATE
  ${PROJECT_BINARY_DIR}/openvdb_maps.h <openvdb/openvdb.h> ${PROJECT_SOURCE_DIR}/cmake/openvdb/grids.h)

# For targets that link OpenVDB.
function(fluidtex_precompiled target)
  target_precompile_headers(${target} REUSE_FROM openvdb_grids)
  target_link_libraries(${target} PRIVATE openvdb_grids)
endfunction()
