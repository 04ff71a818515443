# OpenVDB's headers take longer to read than most of our files take to compile: read once, for all.
add_library(openvdb_headers OBJECT cmake/openvdb_headers.cpp)
target_link_libraries(openvdb_headers PRIVATE fluidtex_flags OpenVDB::openvdb)
target_precompile_headers(openvdb_headers PRIVATE <openvdb/openvdb.h>)

# For targets that link OpenVDB.
function(fluidtex_precompiled target)
  target_precompile_headers(${target} REUSE_FROM openvdb_headers)
endfunction()
