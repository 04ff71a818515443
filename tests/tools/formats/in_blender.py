# blender -b -P in_blender.py -- FILE: imports a .glb or .obj as a user does, and prints what is there then.
import json
import sys

import bpy
import numpy

# The glTF importer of Debian's Blender 3.4 asks for a name that newer NumPy has dropped.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

path = sys.argv[sys.argv.index("--") + 1]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
if path.endswith(".glb"):
    bpy.ops.import_scene.gltf(filepath=path, merge_vertices=False)
else:
    bpy.ops.wm.obj_import(filepath=path)
thing = next(o for o in bpy.data.objects if o.type == "MESH")
mesh = thing.data
mesh.calc_loop_triangles()


def numbers(collection, name, components):
    values = numpy.empty(len(collection) * components, numpy.float32)
    collection.foreach_get(name, values)
    return values.reshape(-1, components)


points = numbers(mesh.vertices, "co", 3)
matrix = numpy.array(thing.matrix_world)
points = points @ matrix[:3, :3].T + matrix[:3, 3]
corners = numpy.empty(3 * len(mesh.loop_triangles), numpy.int32)
mesh.loop_triangles.foreach_get("vertices", corners)
a, b, c = (points[corners[k::3]] for k in range(3))
found = {
    "low": points.min(0).tolist(),
    "high": points.max(0).tolist(),
    "area": float(0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum()),
    "triangles": len(mesh.loop_triangles),
    "uv sets": len(mesh.uv_layers),
    "attributes": [a.name for a in mesh.attributes],
    "colors": [],
}
loop_vertex = numpy.empty(len(mesh.loops), numpy.int32)
mesh.loops.foreach_get("vertex_index", loop_vertex)
for attribute in mesh.color_attributes:
    rgba = numbers(attribute.data, "color", 4)
    if attribute.domain == "CORNER":
        of_vertex = numpy.zeros((len(mesh.vertices), 4))
        of_vertex[loop_vertex] = rgba
        rgba = of_vertex
    found["colors"].append({"red": rgba[:, 0].tolist(), "green": rgba[:, 1].tolist(), "blue": rgba[:, 2].tolist()})
pictures = [node.image for material in mesh.materials for node in material.node_tree.nodes if node.type == "TEX_IMAGE"]
if pictures:
    picture = pictures[0]
    width, height = picture.size
    found["picture"] = [width, height]
    pixels = numpy.array(picture.pixels[:]).reshape(height, width, -1)
    uv = numpy.zeros((len(mesh.vertices), 2))
    uv[loop_vertex] = numbers(mesh.uv_layers[0].data, "uv", 2)
    # Between texels, repeated beyond the edge.
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    i, j = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
    u, v = (x - i)[:, None], (y - j)[:, None]
    at = lambda di, dj: pixels[(j + dj) % height, (i + di) % width, :3]
    found["looked up"] = ((1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1))).tolist()
print("\nFOUND\n" + json.dumps(found))
