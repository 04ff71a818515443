// The texture of a mesh with UVs, with which a liquid begins (texture.start).
#pragma once

#include "scenes/scene.h"
#include "texture/exemplar/image.h"
#include "texture/surface.h"

namespace fluidtex::pipeline {

// Whether the first frame takes its texture from a mesh: there is one, and exemplar coordinates are
// transported. Other methods take the picture's size and the points' spacing from it, and no more.
bool beginsWithMesh(const scenes::Scene& scene);

// The mesh as a textured surface: three vertices for each triangle, whose exemplar coordinates and gradients
// are the triangle's own, on a picture of width x height pixels. Normals are the triangles'. Triangles
// without an area in space or on the picture are left out. spacing: the side of a pixel on the mesh, metres,
// the square root of the mean area. No start: empty.
// Throws sim::MeshError, also where no triangle remains.
texture::TexturedSurface startSurface(const scenes::Scene& scene, int width, int height);

// Sets texture.exemplar.halvings and texture.spacing, so that a point stands for a pixel on the mesh: the
// picture is halved until the mesh has about as many pixels as texture.points (half to twice as many), or
// until they are about as long as texture.spacing, where that is given; but not to less than twice the
// largest window. Nothing where there is no start or no exemplar, or where it was done. Throws as
// startSurface(), and ExemplarError where the picture cannot be read; MeshError too where its pixels would
// break the limits of texture.spacing.
void fitToStart(scenes::Scene& scene);

// 1 where the mesh shows the picture and within two pixels of that, 0 elsewhere: one channel. Texture that is
// made anew should not come from where the picture means nothing. Empty without a start, and where nearly all
// is shown.
texture::Image shownByStart(const texture::TexturedSurface& start, int width, int height, bool toroidal);

// The texture that a surface begins with, for texture::synthesize(): all that is trusted is original and not
// to be renewed; trust falls with the distance from the mesh, is low from about a cell (or spacing, where
// that is longer) on, and where the mesh faces another way. symmetry: of the orientation. voxel: metres.
texture::Carried startOn(const texture::TexturedSurface& start, const texture::SurfaceMesh& mesh,
                         double voxel, int symmetry);

}  // namespace fluidtex::pipeline
