# Camera, light and surroundings of a run's scene in Blender, as the run's own pictures have them
# (render/camera.h, render/sky.h, render/surroundings.h).
import math

import bpy
import numpy as np
from mathutils import Matrix, Vector

import fluidtex
from solids import add_solids

_ROD, _GROUND_GAP = 0.0045, 0.0005  # in diagonals of the domain: render/surroundings.cpp
_FADE_FROM, _FADE_TO = 1.5, 7.0  # likewise; render/surroundings.h


def _link(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def _matt(name, color):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = fluidtex.Nodes(material.node_tree)
    base = nodes.new("ShaderNodeBsdfDiffuse")
    base.inputs["Color"].default_value = (*color, 1.0)
    nodes.put(base.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_camera(scene):
    """The camera of the scene, with a keyframe on every frame if it turns."""
    own, frames = scene["camera"], scene["frames"]
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "VERTICAL", math.radians(own["fov"])
    data.clip_start, data.clip_end = 1e-3, 1e4
    at, arm = Vector(own["at"]), Vector(own["from"]) - Vector(own["at"])
    if own.get("aperture"):
        data.dof.use_dof = True
        data.dof.focus_distance = own["focus"] or arm.length
        data.dof.aperture_fstop = 1e-3 * data.lens / own["aperture"]
    camera = _link("camera", data)
    bpy.context.scene.camera = camera
    camera.rotation_mode = "QUATERNION"
    for frame in range(1, frames + 1) if own["turn"] else (1,):
        progress = (frame - 1) / (frames - 1) if frames > 1 else 0.0
        turn = Matrix.Rotation(math.radians(own["turn"]) * progress, 3, "Z")
        backward = (turn @ arm).normalized()
        right = Vector((0, 0, 1)).cross(backward)
        right = right.normalized() if right.length > 1e-9 else turn @ Vector((1, 0, 0))
        rotation = Matrix((right, backward.cross(right), backward)).transposed().to_quaternion()
        if frame > 1 and rotation.dot(camera.rotation_quaternion) < 0:
            rotation.negate()
        camera.location, camera.rotation_quaternion = at + turn @ arm, rotation
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_quaternion", frame=frame)
    return camera


def add_light(scene):
    """A sun of the scene's size, and a sky that brightens towards the horizon."""
    light = scene["light"]
    color = Vector(light["sun_color"])
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = max(color)  # irradiance of a plane that faces it, as in the scene
    sun.color = color / sun.energy if sun.energy > 0 else color
    sun.angle = math.radians(max(light["sun_size"], 0.1))
    _link("sun", sun).rotation_euler = Vector(light["sun_direction"]).to_track_quat("Z", "Y").to_euler()

    world = bpy.context.scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    # By itself Cycles samples this smooth sky at 2048 times 1024 places, seconds a frame.
    world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 256
    nodes = fluidtex.Nodes(world.node_tree)
    up = nodes.parts(nodes.new("ShaderNodeTexCoord").outputs["Generated"])[2]
    below = nodes.math("SUBTRACT", 1.0, nodes.math("MINIMUM", nodes.math("MAXIMUM", up, 0.0), 1.0))
    sky = nodes.mixed(
        nodes.math("POWER", below, 3.0), tuple(light["sky_color"]), tuple(light["horizon_color"])
    )
    background = nodes.new("ShaderNodeBackground")
    nodes.put(sky, background.inputs["Color"])
    nodes.put(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs["Surface"])


def add_ground(scene, origin):
    size = Vector(scene["domain"]["size"])
    diagonal, middle = size.length, origin + size / 2
    reach, z = _FADE_TO * diagonal, origin.z - _GROUND_GAP * diagonal
    mesh = bpy.data.meshes.new("ground")
    mesh.from_pydata(
        [(middle.x + i * reach, middle.y + j * reach, z) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
        [],
        [(0, 1, 2, 3)],
    )
    material = _matt("ground", scene["render"]["ground_color"])
    nodes = fluidtex.Nodes(material.node_tree, clear=False)
    distance = nodes.vector(
        "LENGTH",
        nodes.vector("SUBTRACT", nodes.new("ShaderNodeNewGeometry").outputs["Position"], tuple(middle)),
        output="Value",
    )
    fade = nodes.new("ShaderNodeMapRange", interpolation_type="SMOOTHSTEP")
    for name, value in (
        ("Value", distance),
        ("From Min", _FADE_FROM * diagonal),
        ("From Max", _FADE_TO * diagonal),
    ):
        nodes.put(value, fade.inputs[name])
    mix = nodes.new("ShaderNodeMixShader")
    output = next(node for node in nodes.tree.nodes if node.type == "OUTPUT_MATERIAL")
    base = output.inputs["Surface"].links[0].from_socket
    nodes.put(fade.outputs[0], mix.inputs[0])
    nodes.put(base, mix.inputs[1])
    nodes.put(nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
    nodes.put(mix.outputs[0], output.inputs["Surface"])
    mesh.materials.append(material)
    _link("ground", mesh)


def add_tank(scene, origin):
    """Rods along the edges of the domain, just outside of it."""
    size = Vector(scene["domain"]["size"])
    rod, bottom = _ROD * size.length, -_GROUND_GAP * size.length
    boxes = [((x, y, bottom), (x + rod, y + rod, size.z)) for x in (-rod, size.x) for y in (-rod, size.y)]
    for low, high in ((bottom, rod), (size.z - rod, size.z)):
        boxes += [((0, y, low), (size.x, y + rod, high)) for y in (-rod, size.y)]
        boxes += [((x, 0, low), (x + rod, size.y, high)) for x in (-rod, size.x)]
    corners, faces = [], []
    for low, high in boxes:
        first = len(corners)
        corners += [
            origin + Vector(((low, high)[k & 1][0], (low, high)[k >> 1 & 1][1], (low, high)[k >> 2][2]))
            for k in range(8)
        ]
        faces += [
            tuple(first + k for k in face)
            for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        ]
    mesh = bpy.data.meshes.new("tank")
    mesh.from_pydata(corners, [], faces)
    mesh.materials.append(_matt("tank", scene["render"]["tank_color"]))
    _link("tank", mesh)


def build(scene, origin):
    """Everything but the liquid, in the current scene, which should be empty; frames, rate and size of the
    picture too. origin: lowest corner of the domain."""
    current = bpy.context.scene
    current.frame_start, current.frame_end = 1, scene["frames"]
    rate = scene["frame_rate"]
    current.render.fps = max(1, math.ceil(rate))
    current.render.fps_base = current.render.fps / rate
    current.render.resolution_x, current.render.resolution_y = scene["render"]["size"]
    current.render.resolution_percentage = 100
    add_camera(scene)
    add_light(scene)
    origin = Vector(origin)
    if scene["render"]["ground"]:
        add_ground(scene, origin)
    if scene["render"]["tank"]:
        add_tank(scene, origin)
    add_solids(scene, _matt)
