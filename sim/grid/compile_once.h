// A grid's non-inline members, compiled in one file: they take longer than most files' own code.
#pragma once

#include <openvdb/openvdb.h>

// linkage: extern in a header, nothing in the file where the grid of this tree is compiled.
#define FLUIDTEX_GRID(linkage, tree_type)                                                                   \
  linkage template class openvdb::Grid<tree_type>;                                                          \
  linkage template class openvdb::tree::Tree<tree_type::RootNodeType>;                                      \
  linkage template class openvdb::tree::InternalNode<tree_type::RootNodeType::ChildNodeType::ChildNodeType, \
                                                     tree_type::RootNodeType::ChildNodeType::LOG2DIM>;      \
  linkage template class openvdb::tree::InternalNode<                                                       \
      tree_type::LeafNodeType, tree_type::RootNodeType::ChildNodeType::ChildNodeType::LOG2DIM>;
