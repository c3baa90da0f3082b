#!/usr/bin/env python3
"""Writes the cases of SCISS meshes: binary files, and the rays that their rules give."""

import json
import math
import pathlib
import struct

FOLDER = pathlib.Path(__file__).parent
SIZE = (64, 32)
SQUARE = (45, -45, -45, 45)  # up, down, left, right
LEVEL = (0, 0, 0, 1)


def grid(columns, rows, screen=lambda s, t: (s, t), texture=lambda s, t: (s, 1 - t)):
    """Vertices {x y z u v w}, x right and y down, u right and v up."""
    nodes = [(c / (columns - 1), r / (rows - 1)) for r in range(rows) for c in range(columns)]
    return [(*screen(s, t), 0, *texture(s, t), 0) for s, t in nodes]


def strip(columns, rows):
    """To and fro, as converted SimCAD files have it: it turns through one triangle along the border, and lacks
    its last index where the last row runs backwards."""
    indices = []
    for r in range(rows - 1):
        if r % 2 == 0:
            for c in range(columns):
                indices += [r * columns + c, (r + 1) * columns + c]
        else:
            for c in range(columns - 1, 0, -1):
                indices += [(r + 1) * columns + c, r * columns + c - 1]
    return indices


def sgc(vertices, indices, version=1, kind=0, sizes=None, fov=SQUARE, rotation=LEVEL, position=(0, 0, 0)):
    sizes = sizes or ((5, len(vertices)) if version == 2 else None)
    head = b"SGC" + struct.pack("<BI11f2I", version, kind, *rotation, *position, *fov, *sizes)
    body = b"".join(struct.pack("<6f", *vertex) for vertex in vertices)
    return head + body + struct.pack("<I%dI" % len(indices), len(indices), *indices)


def ray(s, t, fov=SQUARE, turn=lambda v: v):
    """What is seen at (s, t), from the top left, of a picture with these angles."""
    up, down, left, right = (math.tan(math.radians(angle)) for angle in fov)
    return list(turn((left + s * (right - left), up + t * (down - up), -1)))


def write(name, data, rule, **case):
    (FOLDER / (name + ".sgc")).write_bytes(data)
    content = {"rule": rule, "file": name + ".sgc", "size": SIZE, **case}
    lines = ",\n  ".join(json.dumps(key) + ": " + json.dumps(value) for key, value in content.items())
    (FOLDER / (name + ".json")).write_text("{ " + lines + " }\n")


def rays(*pairs):
    return [{"px": px, "ray": direction} for px, direction in pairs]


PLAIN = sgc(grid(2, 2), strip(2, 2), sizes=(2, 2))

write("version_1", PLAIN, "Version 1: columns and rows, then the vertices, then a triangle strip",
      rays=rays(([16, 8], ray(0.25, 0.25)), ([63, 31], ray(63 / 64, 31 / 32))))

write("version_2", sgc(grid(3, 3), strip(3, 3), version=2),
      "Version 2: the second size is the number of vertices; the strip goes on in version 1's way",
      rays=rays(([16, 8], ray(0.25, 0.25)), ([50, 30], ray(50 / 64, 30 / 32))))

write("version_2_triangles", sgc(grid(2, 2), [0, 1, 2], version=2, sizes=(4, 4)),
      "Version 2 with a first size of 4: the indices are single triangles; what they leave out is a hole",
      rays=rays(([16, 8], ray(0.25, 0.25)), ([48, 24], None)))

write("screen_y_down_texture_v_up",
      sgc(grid(2, 2, screen=lambda s, t: (0.5 * s, 0.5 * t), texture=lambda s, t: (s, 0.5 - 0.5 * t)),
          strip(2, 2), sizes=(2, 2)),
      "x and y are fractions from the top left of the screen, u and v from the bottom left of the picture",
      rays=rays(([8, 4], ray(0.25, 0.625)), ([24, 12], ray(0.75, 0.875)), ([48, 8], None)))

UP = (60, 30, -50, 20)
write("signed_angles", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), fov=UP),
      "Angles are up, down, left, right in degrees with signs: down is positive where the bottom edge is above the axis",
      rays=rays(([0.5, 0.5], ray(0.5 / 64, 0.5 / 32, UP)), ([40, 24], ray(0.625, 0.75, UP))))

HALF = math.radians(30) / 2
write("quaternion_pitch", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), rotation=(math.sin(HALF), 0, 0, math.cos(HALF))),
      "The quaternion (x, y, z, w) turns the view into the world: about x by 30 degrees is 30 degrees up",
      rays=rays(([32, 16], [0, 0.5, -math.sqrt(3) / 2])))

HALF = math.radians(-90) / 2
write("quaternion_heading", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), rotation=(0, math.sin(HALF), 0, math.cos(HALF))),
      "About y by -90 degrees is a quarter turn to the right",
      rays=rays(([32, 16], [1, 0, 0]), ([48, 16], [1, 0, 0.5])))

write("beyond_the_screen",
      sgc(grid(2, 2, screen=lambda s, t: (2 * s - 0.5, 2 * t - 0.5)), strip(2, 2), sizes=(2, 2)),
      "Vertices lie where they are, beyond the screen too; they are not clamped to it",
      rays=rays(([32, 16], ray(0.5, 0.5)), ([0.5, 0.5], ray(0.25 + 0.25 / 64, 0.25 + 0.25 / 32))))


def bent(s, t):
    """The picture's corner (1, 1) is drawn in where the cell's is not."""
    return (s, 1 - t) if (s, t) != (0.5, 0.5) else (0.75, 0.5)


# The node in the middle shows (0.75, 0.5). In the first row the diagonal runs across, from the cell's top
# right to its bottom left. Wherever the middle weighs w, u is what it is in an even picture and w / 4 more.
write("strip_alternates", sgc(grid(3, 3, texture=bent), strip(3, 3), sizes=(3, 3)),
      "The strip cuts cells of even rows from the top right to the bottom left, those of odd rows from the top left to the bottom right",
      rays=rays(([16, 8], ray(0.25, 0.25)),             # on the first diagonal: the middle weighs nothing
                ([24, 12], ray(0.375 + 0.125, 0.375)),  # the middle weighs 1/2
                ([16, 24], ray(0.25, 0.75)),            # odd row: the diagonal from (0, 1/2) to (1/2, 1) avoids it
                ([24, 20], ray(0.375 + 0.125, 0.625)),  # the upper right triangle: the middle weighs 1/2
                ([8, 24], ray(0.125, 0.75))),           # the lower left triangle: nothing
      assumptions={"interpolation": "triangles_listed"})

write("strip_end", sgc(grid(3, 3), strip(3, 3), sizes=(3, 3)),
      "A strip that ends one index short of its last half cell is completed, as the grid is in other formats",
      rays=rays(([4, 28], ray(0.0625, 0.875)), ([12, 24], ray(0.1875, 0.75))), assumptions={"strip_end": "completed"})

write("strip_end_as_listed", sgc(grid(3, 3), strip(3, 3), sizes=(3, 3)),
      "unless the user wants the hole",
      assume={"strip_end": "as_listed"}, rays=rays(([4, 28], None), ([12, 20], ray(0.1875, 0.625))))

write("bilinear", sgc(grid(3, 3, texture=bent), strip(3, 3), sizes=(3, 3)),
      "A user may take the grid as bilinear instead",
      assume={"interpolation": "bilinear"},
      rays=rays(([16, 8], ray(0.25 + 0.25 * 0.25, 0.25)), ([24, 12], ray(0.375 + 0.25 * 0.5625, 0.375))))

write("strip_turns",
      sgc(grid(3, 3, screen=lambda s, t: (s * (0.5 - t * (1 - t)), t),
               texture=lambda s, t: (s * (0.9 if t == 0.5 else 1), 1 - t)),
          [0, 3, 1, 4, 2, 5, 2, 2, 5, 8, 4, 7, 3, 6], sizes=(3, 3)),
      "Where the strip turns, triangles along the border of the grid are none, though they would have an area",
      rays=rays(([8, 16], ray(0.45, 0.5)), ([25.6, 16], None)))

write("position", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), position=(0, 1, 0)),
      "The position is not used, since the picture is far away", warning="position",
      rays=rays(([16, 8], ray(0.25, 0.25))))

NAN = float("nan")
write("nan_is_a_hole", sgc([(NAN, 0, 0, 0, 1, 0)] + grid(2, 2)[1:], strip(2, 2), sizes=(2, 2)),
      "A vertex that is not a number leaves a hole where its triangles would be",
      rays=rays(([16, 8], None), ([48, 24], ray(0.75, 0.75))))

write("cube", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), kind=1), "Type 1, cubes, is refused", error="type: expected 0")
write("version_3", sgc(grid(2, 2), strip(2, 2), version=3, sizes=(2, 2)), "Other versions are refused",
      error="version: expected 1 or 2, found 3")
write("truncated", PLAIN[:-1], "A file that ends early is refused", error="indices: expected 4 of them")
write("too_long", PLAIN + b"\0", "Bytes after the indices are refused: a count is wrong", error="indices: expected 4 of them")
write("too_many_vertices", sgc(grid(2, 2), strip(2, 2), sizes=(0xFFFFFFFF, 0xFFFFFFFF)),
      "Sizes beyond the bytes that are there are refused", error="size: expected 18446744065119617025 vertices")
write("index_out_of_range", sgc(grid(2, 2), [0, 1, 2, 4], sizes=(2, 2)), "Indices beyond the vertices are refused",
      error="indices[3]: expected less than 4, found 4")
write("no_rotation", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), rotation=(0, 0, 0, 0)),
      "A quaternion that is none is refused", error="quaternion: expected a rotation")
write("no_picture", sgc(grid(2, 2), strip(2, 2), sizes=(2, 2), fov=(20, 20, -45, 45)),
      "A picture without height is refused", error="frustum: expected a picture with an area")
write("header_only", PLAIN[:40], "A file without its whole header is refused", error="expected a header")
