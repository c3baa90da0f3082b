# What the cases of several formats are made with: rays by closed formulas, and files byte by byte.
import json
import math
import os
import struct


def rotation(yaw, pitch, roll):
    """World from view: yaw turns right, pitch up, roll clockwise; x right, y up, ahead is -z. Degrees."""
    y, p, r = (math.radians(a) for a in (yaw, pitch, roll))
    about_y = [[math.cos(y), 0, -math.sin(y)], [0, 1, 0], [math.sin(y), 0, math.cos(y)]]
    about_x = [[1, 0, 0], [0, math.cos(p), -math.sin(p)], [0, math.sin(p), math.cos(p)]]
    about_z = [[math.cos(r), math.sin(r), 0], [-math.sin(r), math.cos(r), 0], [0, 0, 1]]
    return multiply(multiply(about_y, about_x), about_z)


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def turned(matrix, v):
    return [sum(matrix[i][k] * v[k] for k in range(3)) for i in range(3)]


def frustum_ray(u, v, left, right, down, up, ypr=(0, 0, 0)):
    """The ray at the fraction (u, v) of a flat picture, v from its top. Angles from the axis, degrees."""
    l, r, d, t = (math.tan(math.radians(a)) for a in (left, right, down, up))
    return turned(rotation(*ypr), [l + u * (r - l), t + v * (d - t), -1])


def flat_ray(u, v, fov, aspect):
    """The same straight ahead with square pixels, `fov` degrees wide."""
    half = math.tan(math.radians(fov / 2))
    return [half * (2 * u - 1), half / aspect * (1 - 2 * v), -1]


def pfm(rows, big_endian=False, scale=None, channels=3):
    """`rows` as the file has them, which a PFM counts from the bottom up."""
    order = ">" if big_endian else "<"
    sign = scale if scale is not None else ("1.0" if big_endian else "-1.0")
    numbers = [number for row in rows for node in row for number in node]
    header = f"{'PF' if channels == 3 else 'Pf'}\n{len(rows[0])} {len(rows)}\n{sign}\n".encode()
    return header + struct.pack(f"{order}{len(numbers)}f", *numbers)


class Folder:
    def __init__(self, script):
        self.path = os.path.dirname(os.path.abspath(script))

    def write(self, name, data):
        with open(os.path.join(self.path, name), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())

    def case(self, name, rule, file, **keys):
        """`rays` is a list of ((x, y), ray or None)."""
        case = {"rule": rule, "file": file}
        if "rays" in keys:
            keys["rays"] = [{"px": list(px), "ray": ray and [round(c, 15) for c in ray]} for px, ray in keys["rays"]]
        case.update(keys)
        with open(os.path.join(self.path, name + ".json"), "w") as out:
            out.write(json.dumps(case, indent=1) + "\n")
