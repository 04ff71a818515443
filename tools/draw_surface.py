#!/usr/bin/env python3
"""Draws a frame's mesh, orientation field and singularities as SVG.

    tools/draw_surface.py OUT FRAME FILE.svg [--every N] [--points] [--crop X Y WIDTH HEIGHT]

OUT is the folder of a run. Every N-th vertex that faces the camera gets an arrow (0: none). Red points: singularities that
turn with the way around them, blue ones: against it. With --points every vertex is a dot. --crop shows a part of the picture,
in shares of its size.
"""
import argparse
import json
import math
import struct
from pathlib import Path

WIDTH = 1200


def read_ply(path):
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    sizes = {"float": ("f", 4), "uchar": ("B", 1), "int": ("i", 4)}
    names, layout, vertices, faces, in_vertices = [], "<", 0, 0, False
    for line in header.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            in_vertices = words[1] == "vertex"
            if in_vertices:
                vertices = int(words[2])
            else:
                faces = int(words[2])
        elif words[0] == "property" and in_vertices:
            names.append(words[2])
            layout += sizes[words[1]][0]
    step = struct.calcsize(layout)
    rows = [dict(zip(names, row)) for row in struct.iter_unpack(layout, body[: vertices * step])]
    triangles = [t[1:] for t in struct.iter_unpack("<B3i", body[vertices * step : vertices * step + faces * 13])]
    return rows, triangles


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(dot(a, a)) or 1.0
    return [x / length for x in a]


class Camera:
    def __init__(self, camera, size):
        self.eye = camera["from"]
        self.forward = unit(sub(camera["at"], self.eye))
        self.right = unit(cross(self.forward, [0, 0, 1]))
        self.up = cross(self.right, self.forward)
        self.height = WIDTH * size[1] / size[0]
        self.scale = 0.5 * self.height / math.tan(0.5 * math.radians(camera["fov"]))

    def depth(self, x):
        return dot(sub(x, self.eye), self.forward)

    def project(self, x):
        ray = sub(x, self.eye)
        s = self.scale / dot(ray, self.forward)
        return 0.5 * WIDTH + s * dot(ray, self.right), 0.5 * self.height - s * dot(ray, self.up)


def shapes(rows, triangles, singular, camera, every, spacing, points):
    """(depth, SVG) of everything that faces the camera."""
    position = [[r["x"], r["y"], r["z"]] for r in rows]
    flat = [camera.project(x) for x in position]
    for t in triangles:
        a, b, c = (position[i] for i in t)
        normal = unit(cross(sub(b, a), sub(c, a)))
        facing = -dot(normal, unit(sub(a, camera.eye)))
        if facing <= 0.0:
            continue
        grey = int(150 + 90 * facing)
        corners = " ".join(f"{flat[i][0]:.1f},{flat[i][1]:.1f}" for i in t)
        yield max(camera.depth(x) for x in (a, b, c)), f'<polygon points="{corners}" fill="rgb({grey},{grey},{grey})"/>'
    lift = 0.5 * spacing
    if points:
        for r, x, (px, py) in zip(rows, position, flat):
            if dot([r["nx"], r["ny"], r["nz"]], sub(camera.eye, x)) > 0.0:
                yield camera.depth(x) - lift, f'<circle cx="{px:.2f}" cy="{py:.2f}" r="{0.14 * spacing * camera.scale / camera.depth(x):.2f}" class="p"/>'
    for r, x in list(zip(rows, position))[:: every or len(rows) + 1]:
        n, d = [r["nx"], r["ny"], r["nz"]], [r["dx"], r["dy"], r["dz"]]
        if dot(n, sub(camera.eye, x)) <= 0.0:
            continue
        side = cross(n, d)
        length = 0.9 * math.sqrt(every) * spacing

        def at(along, across):
            return camera.project([p + lift * m + length * (along * e + across * s) for p, m, e, s in zip(x, n, d, side)])

        tip, tail, left, right = at(0.5, 0), at(-0.5, 0), at(0.2, 0.2), at(0.2, -0.2)
        path = f"M{tail[0]:.1f} {tail[1]:.1f}L{tip[0]:.1f} {tip[1]:.1f}M{left[0]:.1f} {left[1]:.1f}L{tip[0]:.1f} {tip[1]:.1f}L{right[0]:.1f} {right[1]:.1f}"
        yield camera.depth(x) - lift, f'<path d="{path}" class="a"/>'
    for x, y, z, turns in singular:
        px, py = camera.project([x, y, z])
        yield camera.depth([x, y, z]) - 2 * lift, f'<circle cx="{px:.1f}" cy="{py:.1f}" r="6" fill="{"#d22" if turns > 0 else "#25d"}"/>'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("frame", type=int)
    parser.add_argument("file", type=Path)
    parser.add_argument("--every", type=int, default=12)
    parser.add_argument("--points", action="store_true")
    parser.add_argument("--crop", type=float, nargs=4, default=(0, 0, 1, 1))
    options = parser.parse_args()
    run = json.loads((options.out / "run.json").read_text())
    frame = next(f for f in run["frames"] if f["frame"] == options.frame)
    camera_of = dict(run["scene"]["camera"])
    turn = camera_of.pop("turn", 0.0)
    if turn:
        angle = math.radians(turn) * (options.frame - 1) / max(1, run["scene"]["frames"] - 1)
        x, y, z = sub(camera_of["from"], camera_of["at"])
        c, s = math.cos(angle), math.sin(angle)
        camera_of["from"] = [p + q for p, q in zip(camera_of["at"], [c * x - s * y, s * x + c * y, z])]
    camera = Camera(camera_of, run["scene"]["render"]["size"])
    rows, triangles = read_ply(options.out / "surface" / f"{options.frame:04d}.ply")
    drawn = sorted(shapes(rows, triangles, frame["singular_points"], camera, options.every, frame["edge_mean"], options.points), key=lambda item: -item[0])
    style = "polygon{stroke:#777;stroke-width:.4} .a{stroke:#063;stroke-width:1.6;fill:none} circle{stroke:#fff;stroke-width:1.5} .p{fill:#a30;stroke:none}"
    x, y, w, h = (share * size for share, size in zip(options.crop, [WIDTH, camera.height] * 2))
    options.file.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x:.0f} {y:.0f} {w:.0f} {h:.0f}" width="{WIDTH}" height="{WIDTH * h / w:.0f}"><style>{style}</style>'
        '<rect x="{x:.0f}" y="{y:.0f}" width="100%" height="100%" fill="#fff"/>' + "\n".join(svg for _, svg in drawn) + "</svg>\n"
    )


if __name__ == "__main__":
    main()
