#!/usr/bin/env python3
"""Writes torus.ply beside itself: a closed ring about an axis that leans towards the camera of torus.toml, as triangles
that are counter-clockwise from outside."""
import math
import os
import struct

CENTER = (0.5, 0.5, 0.5)
RING, TUBE = 0.3, 0.12  # metres
AROUND, ACROSS = 128, 52  # vertices
LEAN = math.atan(0.5)  # of the axis from upright


def corner(i, j):
    a, b = 2.0 * math.pi * i / AROUND, 2.0 * math.pi * j / ACROSS
    out = RING + TUBE * math.cos(b)
    x, y, z = out * math.cos(a), out * math.sin(a), TUBE * math.sin(b)
    y, z = y * math.cos(LEAN) - z * math.sin(LEAN), y * math.sin(LEAN) + z * math.cos(LEAN)
    return tuple(c + p for c, p in zip(CENTER, (x, y, z)))


def main():
    name = os.path.join(os.path.dirname(os.path.abspath(__file__)), "torus.ply")
    faces = []
    for i in range(AROUND):
        for j in range(ACROSS):
            a, b = i * ACROSS + j, (i + 1) % AROUND * ACROSS + j
            c, d = (i + 1) % AROUND * ACROSS + (j + 1) % ACROSS, i * ACROSS + (j + 1) % ACROSS
            faces += [(a, b, c), (a, c, d)]
    with open(name, "wb") as out:
        out.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                   "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n"
                   % (AROUND * ACROSS, len(faces))).encode())
        for i in range(AROUND):
            for j in range(ACROSS):
                out.write(struct.pack("<3f", *corner(i, j)))
        for face in faces:
            out.write(struct.pack("<B3i", 3, *face))


if __name__ == "__main__":
    main()
