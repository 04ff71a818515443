"""Checks the meshes of examples/texture_a_surface.cpp in a folder: closed surfaces of the ellipsoids that its
flow makes of a ball, whose texture moves with the liquid.
"""

import collections
import math
import pathlib
import sys

RADIUS, RATE, FALL, SECONDS = 0.1, 0.3, -0.5, 1 / 24


def read(file):
    """Vertices as lists of numbers, triangles as lists of indices."""
    head, body = file.read_text().split("end_header\n")
    elements = [line.split() for line in head.splitlines() if line.startswith("element")]
    count = {name: int(number) for _, name, number in elements}
    lines = body.splitlines()
    assert len(lines) == count["vertex"] + count["face"], file
    vertices = [[float(number) for number in line.split()] for line in lines[: count["vertex"]]]
    triangles = [[int(number) for number in line.split()[1:]] for line in lines[count["vertex"] :]]
    return vertices, triangles


def check_mesh(vertices, triangles, time):
    along, across = math.exp(RATE * time), math.exp(-0.5 * RATE * time)
    for x, y, z, nx, ny, nz, *colours, s, t in vertices:
        # On the ellipsoid, to a tenth of a voxel.
        q = math.sqrt((x / across) ** 2 + (y / across) ** 2 + ((z - FALL * time) / along) ** 2)
        assert abs(q - RADIUS) < 1e-3, (x, y, z, q)
        outward = x * nx / across**2 + y * ny / across**2 + (z - FALL * time) * nz / along**2
        assert outward > 0.0
        assert 0.0 <= s <= 1.0 and 0.0 <= t <= 1.0, (s, t)
    edges = collections.Counter()
    volume = 0.0
    for a, b, c in triangles:
        for edge in ((a, b), (b, c), (c, a)):
            edges[edge] += 1
        p, q, r = (vertices[v][:3] for v in (a, b, c))
        volume += (
            p[0] * (q[1] * r[2] - q[2] * r[1])
            + p[1] * (q[2] * r[0] - q[0] * r[2])
            + p[2] * (q[0] * r[1] - q[1] * r[0])
        ) / 6
    # Closed and oriented: each edge once in either direction; of the topology of a ball.
    assert all(count == 1 and edges[(b, a)] == 1 for (a, b), count in edges.items())
    assert len(vertices) - len(edges) // 2 + len(triangles) == 2
    ball = 4 / 3 * math.pi * RADIUS**3
    assert abs(volume / ball - 1) < 0.01, volume / ball
    colours = {tuple(vertex[6:9]) for vertex in vertices}
    assert len(colours) > 500, len(colours)


def nearest(points, x):
    return min(range(len(points)), key=lambda n: sum((points[n][i] - x[i]) ** 2 for i in range(3)))


def check_transport(before, after):
    """Most of the texture is where the flow has carried it: near a carried point the colour is its own."""
    along, across = math.exp(RATE * SECONDS), math.exp(-0.5 * RATE * SECONDS)
    carried = [[v[0] * across, v[1] * across, v[2] * along + FALL * SECONDS] for v in before]
    same = other = 0.0
    for n in range(0, len(after), 20):
        near = nearest(carried, after[n])
        same += sum(abs(after[n][i] - before[near][i]) for i in (6, 7, 8))
        far = before[(near + len(before) // 2) % len(before)]
        other += sum(abs(after[n][i] - far[i]) for i in (6, 7, 8))
    assert same < 0.4 * other, (same, other)


def main(folder):
    meshes = [read(file) for file in sorted(pathlib.Path(folder).glob("drop_*.ply"))]
    assert len(meshes) == 3, len(meshes)
    for n, (vertices, triangles) in enumerate(meshes):
        check_mesh(vertices, triangles, n * SECONDS)
    # The frame's fall is relative: the drop of the second frame begins at FALL * SECONDS.
    check_transport(meshes[0][0], meshes[1][0])


main(sys.argv[1])
