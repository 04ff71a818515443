# The solids of a run's scene as Blender objects: shape, colour, motion, when they are there. Keys:
# scenes/README.md.
import math
import os

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix, Quaternion, Vector


def _box(mesh, low, high):
    bmesh.ops.create_cube(
        mesh, size=1.0, matrix=Matrix.Translation((low + high) / 2) @ Matrix.Diagonal((*(high - low), 1.0))
    )


def _cylinder(mesh, start, end, radius):
    axis = end - start
    place = Matrix.Translation((start + end) / 2) @ axis.to_track_quat("Z", "Y").to_matrix().to_4x4()
    bmesh.ops.create_cone(
        mesh, cap_ends=True, segments=128, radius1=radius, radius2=radius, depth=axis.length, matrix=place
    )


def _cut(mesh, point, normal):
    """Takes away what lies beyond a plane, and closes the cut."""
    cut = bmesh.ops.bisect_plane(
        mesh,
        geom=mesh.verts[:] + mesh.edges[:] + mesh.faces[:],
        plane_co=point,
        plane_no=normal,
        clear_outer=True,
    )["geom_cut"]
    edges = [part for part in cut if isinstance(part, bmesh.types.BMEdge)]
    if edges:
        bmesh.ops.holes_fill(mesh, edges=edges, sides=0)


def _read(mesh, file, place):
    """A mesh from a file, put in its place."""
    before = set(bpy.data.objects)
    ending = file.rsplit(".", 1)[-1].lower()
    if ending == "obj":
        bpy.ops.wm.obj_import(filepath=file, forward_axis="Y", up_axis="Z")
    elif bpy.app.version >= (4, 1):
        getattr(bpy.ops.wm, f"{ending}_import")(filepath=file, forward_axis="Y", up_axis="Z")
    else:
        getattr(bpy.ops.import_mesh, ending)(filepath=file)
    upright = Matrix.Rotation(math.pi / 2, 4, "X") if place.get("up") == "y" else Matrix.Identity(4)
    turned = Euler([math.radians(degrees) for degrees in place.get("rotate", (0, 0, 0))]).to_matrix().to_4x4()
    matrix = (
        Matrix.Translation(place.get("translate", (0, 0, 0)))
        @ turned
        @ Matrix.Scale(place.get("scale", 1.0), 4)
        @ upright
    )
    for thing in set(bpy.data.objects) - before:
        part = bmesh.new()
        part.from_mesh(thing.data)
        bmesh.ops.transform(part, matrix=matrix @ thing.matrix_world, verts=part.verts)
        _join(mesh, part)
        bpy.data.meshes.remove(thing.data)


def _ground(mesh, field, low, high):
    """The heights of a picture, its rim going on to the sides of the domain; closed by a floor below."""
    image = bpy.data.images.load(field["file"])
    image.colorspace_settings.is_data = True
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    heights = field["low"] + (field["high"] - field["low"]) * pixels.reshape(height, width, 4)[..., 0]
    pixel, corner = field["pixel"], field["translate"]
    x, y = [corner[axis] + (np.arange(count) + 0.5) * pixel for axis, count in ((0, width), (1, height))]
    rim = lambda places, axis: np.concatenate(
        [[min(places[0], low[axis])], places, [max(places[-1], high[axis])]]
    )
    x, y = rim(x, 0), rim(y, 1)
    heights = np.pad(heights + corner[2], 1, mode="edge")
    base = min(low[2], heights.min()) - pixel
    top = [[mesh.verts.new((x[i], y[j], heights[j, i])) for i in range(len(x))] for j in range(len(y))]
    for j in range(len(y) - 1):
        for i in range(len(x) - 1):
            mesh.faces.new((top[j][i], top[j][i + 1], top[j + 1][i + 1], top[j + 1][i]))
    around = top[0] + [row[-1] for row in top[1:]] + top[-1][-2::-1] + [row[0] for row in top[-2:0:-1]]
    below = [mesh.verts.new((*vertex.co[:2], base)) for vertex in around]
    for k in range(len(around)):
        mesh.faces.new((around[k - 1], below[k - 1], below[k], around[k]))
    mesh.faces.new(below[::-1])


def _join(mesh, other):
    """Adds another mesh, and frees it."""
    own = bpy.data.meshes.new("part")
    other.to_mesh(own)
    other.free()
    mesh.from_mesh(own)
    bpy.data.meshes.remove(own)


def _object(name, mesh):
    """An object of a mesh, which is freed; linked to no scene."""
    own = bpy.data.meshes.new(name)
    mesh.to_mesh(own)
    mesh.free()
    return bpy.data.objects.new(name, own)


def _without(first, others):
    """The first of some meshes without the others."""
    scene = bpy.context.scene
    whole = _object("whole", first)
    scene.collection.objects.link(whole)
    for other in others:
        hole = _object("hole", other)
        scene.collection.objects.link(hole)
        modifier = whole.modifiers.new("hole", "BOOLEAN")
        modifier.operation, modifier.object, modifier.solver = "DIFFERENCE", hole, "EXACT"
    result = bmesh.new()
    result.from_object(whole, bpy.context.evaluated_depsgraph_get())
    for thing in [whole] + [modifier.object for modifier in whole.modifiers]:
        bpy.data.meshes.remove(thing.data)
    return result


def shape_mesh(shape, low, high):
    """A shape as a mesh. low, high: the box of the domain, which shapes without an end are drawn in."""
    mesh = bmesh.new()
    kind = next(
        key
        for key in (
            "box",
            "sphere",
            "cylinder",
            "half_space",
            "mesh",
            "mesh_sequence",
            "height_field",
            "union",
            "difference",
        )
        if shape.get(key)
    )
    own = shape[kind]
    if kind == "box":
        _box(mesh, Vector(own["min"]), Vector(own["max"]))
    elif kind == "sphere":
        bmesh.ops.create_icosphere(
            mesh, subdivisions=6, radius=own["radius"], matrix=Matrix.Translation(own["center"])
        )
    elif kind == "cylinder":
        _cylinder(mesh, Vector(own["from"]), Vector(own["to"]), own["radius"])
    elif kind == "half_space":
        _box(mesh, low, high)
        _cut(mesh, Vector(own["point"]), Vector(own["normal"]))
    elif kind == "mesh":
        _read(mesh, own["file"], own)
    elif kind == "mesh_sequence":
        _read(mesh, _file_of(own, 0), own)
    elif kind == "height_field":
        _ground(mesh, own, low, high)
    elif kind == "union":
        for part in own:
            _join(mesh, shape_mesh(part, low, high))
    else:
        parts = [shape_mesh(part, low, high) for part in own]
        mesh.free()
        mesh = _without(parts[0], parts[1:])
    return mesh


def _file_of(sequence, number):
    """File of a sequence by its number counted from 0."""
    folder, name = os.path.split(sequence["files"])
    return os.path.join(folder, name % (sequence["first"] + number))


def _clipped(mesh, low, high, sides, moved):
    """Solids are drawn in the domain; where it has no end, whole. One that moves is not cut."""
    if moved:
        return
    for axis, name in enumerate("xyz"):
        for side, limit, sign in (("low", low, -1), ("high", high, 1)):
            beyond = any(sign * (vertex.co[axis] - limit[axis]) > 1e-6 for vertex in mesh.verts)
            if beyond and sides.get(f"{name}_{side}") != "unbounded":
                normal = Vector((0, 0, 0))
                normal[axis] = sign
                _cut(mesh, limit, normal)


def _change_shape(thing, sequence, frame_rate, low, high):
    """The files of a sequence as absolute shape keys, which Blender goes through in straight lines."""
    count = sequence["last"] - sequence["first"] + 1
    for number in range(count):
        mesh = bmesh.new()
        _read(mesh, _file_of(sequence, number), sequence)
        key = thing.shape_key_add(name=str(number))
        key.interpolation = "KEY_LINEAR"
        key.data.foreach_set("co", np.array([vertex.co[:] for vertex in mesh.verts], np.float32).ravel())
        mesh.free()
    keys = thing.data.shape_keys
    keys.use_relative = False
    for number in (0, count - 1):
        time = sequence["start"] + number / sequence["frame_rate"]
        keys.eval_time = keys.key_blocks[number].frame
        keys.keyframe_insert("eval_time", frame=1 + time * frame_rate)
    _straight(keys)


def _straight(owner):
    """Between keyframes of an animation all goes evenly."""
    for curve in owner.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def _move(thing, solid, frame_rate, frames):
    """Turned about its axis, then moved, at every frame; what turns goes along chords in between."""
    keys, pivot, axis = solid["keyframe"], Vector(solid["pivot"]), Vector(solid["axis"]).normalized()
    times = [key["time"] for key in keys]
    thing.rotation_mode = "QUATERNION"
    for frame in range(1, frames + 1):
        time = (frame - 1) / frame_rate
        turn = math.radians(np.interp(time, times, [key["turn"] for key in keys]))
        move = Vector([np.interp(time, times, [key["move"][k] for key in keys]) for k in range(3)])
        rotation = Quaternion(axis, turn)
        thing.rotation_quaternion = rotation
        thing.location = pivot - rotation @ pivot + move
        thing.keyframe_insert("rotation_quaternion", frame=frame)
        thing.keyframe_insert("location", frame=frame)
    _straight(thing)


def _appear(thing, solid, frame_rate, frames):
    """Hidden before `from` and from `until` on."""
    begin, end = solid["from"], solid["until"] if solid["until"] is not None else math.inf
    shown = [begin <= (frame - 1) / frame_rate < end for frame in range(1, frames + 1)]
    for frame, here in enumerate(shown, 1):
        if frame == 1 or here != shown[frame - 2]:
            for path in ("hide_render", "hide_viewport"):
                setattr(thing, path, not here)
                thing.keyframe_insert(path, frame=frame)


def add_solids(scene, material):
    """Objects of all visible solids of a run's scene, linked to the current scene. material(name, color):
    makes one."""
    low, high = Vector((0, 0, 0)), Vector(scene["domain"]["size"])
    made = []
    for solid in scene.get("solid") or []:
        if not solid["visible"]:
            continue
        mesh = shape_mesh(solid, low, high)
        moved = bool(solid.get("keyframe"))
        if not solid.get("mesh_sequence"):
            _clipped(mesh, low, high, scene["domain"].get("sides") or {}, moved)
        thing = _object(solid["name"], mesh)
        bpy.context.scene.collection.objects.link(thing)
        thing.data.materials.append(material(solid["name"], solid["color"]))
        if solid.get("mesh_sequence"):
            _change_shape(thing, solid["mesh_sequence"], scene["frame_rate"], low, high)
        if moved:
            _move(thing, solid, scene["frame_rate"], scene["frames"])
        _appear(thing, solid, scene["frame_rate"], scene["frames"])
        made.append(thing)
    return made
