// OpenVDB's own grids, as files hold them, are compiled in openvdb_grids.cpp alone: a grid's virtual
// functions take 10 s in each file that makes one. Precompiled for all that links OpenVDB, see
// precompile.cmake.
#pragma once

#include <openvdb/openvdb.h>

extern template class openvdb::Grid<openvdb::FloatTree>;
extern template class openvdb::tree::Tree<openvdb::FloatTree::RootNodeType>;
extern template class openvdb::Grid<openvdb::Vec3STree>;
extern template class openvdb::tree::Tree<openvdb::Vec3STree::RootNodeType>;
extern template class openvdb::Grid<openvdb::MaskTree>;
extern template class openvdb::tree::Tree<openvdb::MaskTree::RootNodeType>;
