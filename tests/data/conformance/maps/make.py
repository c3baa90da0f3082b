#!/usr/bin/env python3
# Writes the PFM maps of this folder and what they stand for.
import math
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from closed_formulas import Folder, flat_ray, pfm

folder = Folder(__file__)
NAN = math.nan
SIZE = [64, 32]
ASPECT = 2
INVERSE = {"map_kind": "inverse", "map_values": "absolute", "source": "perspective"}


def picture(u, v):
    return flat_ray(u, v, 90, ASPECT)


def case(name, rule, data, **keys):
    folder.write(name + ".pfm", data)
    folder.case(name, rule, name + ".pfm", size=keys.pop("size", SIZE), **keys)


# Four corners of the part from 0.1 to 0.9 across and from 0.2 to 0.6 down, as a PFM has rows: the bottom one first.
CORNERS = [[(0.1, 0.6, 0), (0.9, 0.6, 0)], [(0.1, 0.2, 0), (0.9, 0.2, 0)]]
AT_CORNERS = [((0, 0), picture(0.1, 0.2)), ((64, 0), picture(0.9, 0.2)), ((0, 32), picture(0.1, 0.6)),
              ((32, 16), picture(0.5, 0.4))]

case("inverse", "An inverse map tells which position of the picture a pixel shows, v from the top; the file begins "
     "with the bottom row.", pfm(CORNERS), rays=AT_CORNERS,
     assumptions={"map_kind": "inverse", "map_values": "absolute", "row_order": "bottom_first", "source_v": "down",
                  "node_alignment": "corners"})
# At a quarter of the width and three quarters of the height, from the top. Where a cell is cut in two, (s, t) is a
# sum of its corners at (0, 0), (1, 1) and the one between; cells are affine but for the last corner, moved by 0.2.
BENT = [[(0.1, 0.6, 0), (0.9, 0.8, 0)], [(0.1, 0.2, 0), (0.9, 0.2, 0)]]
case("inverse_bilinear", "Between the nodes of a coarse inverse map positions are bilinear.", pfm(BENT),
     assumptions={"interpolation": "bilinear"},
     rays=[((16, 24), picture(0.3, 0.2 + 0.4 * 0.75 + 0.2 * 0.25 * 0.75)),
           ((48, 8), picture(0.7, 0.2 + 0.4 * 0.25 + 0.2 * 0.75 * 0.25))])
case("inverse_triangles", "The user may have the cells of a coarse inverse map cut from the first node to the last, "
     "as meshes are drawn.", pfm(BENT), assume={"interpolation": "triangles"},
     rays=[((16, 24), picture(0.3, 0.2 + 0.4 * 0.75 + 0.2 * 0.25)),
           ((48, 8), picture(0.7, 0.2 + 0.4 * 0.25 + 0.2 * 0.25))])
case("inverse_triangles_across", "Or from the second node to the third.", pfm(BENT),
     assume={"interpolation": "triangles_across"},
     rays=[((16, 8), picture(0.3, 0.2 + 0.4 * 0.25)),
           ((48, 24), picture(0.7, 0.2 + 0.4 * 0.75 + 0.2 * 0.5))])
case("scale", "A PFM's scale is ignored but for its sign, and that is an assumption.", pfm(CORNERS, scale="-2"),
     rays=AT_CORNERS, assumptions={"scale": "ignored"})
case("scale_is_a_factor", "A PFM's scale multiplies the numbers where the user says so.",
     pfm([[(u / 2, v / 2, w) for u, v, w in row] for row in CORNERS], scale="-2"), rays=AT_CORNERS,
     assume={"scale": "factor"})
case("big_endian", "A positive scale means big-endian numbers.", pfm(CORNERS, big_endian=True), rays=AT_CORNERS)
case("wrong_byte_order", "A scale of the wrong sign is seen by numbers that make no sense.",
     pfm(CORNERS, scale="1.0"), error="byte order")
case("header_white_space", "Any white space separates the words of the header, and one character ends it.",
     b"PF 2\t2\r\n-1.000000\n" + pfm(CORNERS)[-48:], rays=AT_CORNERS)
case("upside_down", "A first row with v near 0 comes from a writer who mixed conventions: the row order is turned, "
     "with a warning.", pfm(CORNERS[::-1]), rays=AT_CORNERS, assumptions={"row_order": "top_first"},
     warning="row order")
case("row_order_given", "What the user says of the row order is taken, whatever the numbers say.", pfm(CORNERS[::-1]),
     assume={"row_order": "bottom_first"}, rays=[((0, 0), picture(0.1, 0.6)), ((0, 32), picture(0.1, 0.2))])
case("source_v_up", "With v from the bottom of the picture the first row of the file is the top one.",
     pfm(CORNERS), assume={"source_v": "up"}, assumptions={"row_order": "top_first"},
     rays=[((0, 0), picture(0.1, 0.4)), ((64, 32), picture(0.9, 0.8))])
case("third_channel_nan", "Evans & Sutherland leave the third channel NaN, begin with the top row and count v "
     "upwards; nodes with it are valid.", pfm([[(u, v, NAN) for u, v, _ in row] for row in CORNERS]),
     assumptions={"source_v": "up", "row_order": "top_first"},
     rays=[((0, 0), picture(0.1, 0.4)), ((64, 32), picture(0.9, 0.8))])
case("centers", "Nodes are texels where there are about as many as pixels: the first one lies half a texel inside, and "
     "beyond it the map goes on straight.",
     pfm([[((x + 0.5) / 4, 1 - (y + 0.5) / 4, 0) for x in range(4)] for y in range(4)]), size=[4, 4],
     assumptions={"node_alignment": "centers"},
     rays=[((0.5, 0.5), flat_ray(0.125, 0.125, 90, 1)), ((0, 0), flat_ray(0, 0, 90, 1)),
           ((4, 2), flat_ray(1, 0.5, 90, 1))])
case("corners_given", "With nodes at the corners the outermost ones lie on the border.",
     pfm([[((x + 0.5) / 4, 1 - (y + 0.5) / 4, 0) for x in range(4)] for y in range(4)]), size=[4, 4],
     assume={"node_alignment": "corners"}, rays=[((0, 0), flat_ray(0.125, 0.125, 90, 1))])

WITH_HOLE = [[(x / 4, 1 - y / 4, 0) for x in range(5)] for y in range(5)]
WITH_HOLE[2][2] = (NAN, 0.5, 0)
WITH_HOLE[0][4] = (-1, -1, 0)
case("holes", "Cells with a node that is NaN, or at (-1, -1), are holes.", pfm(WITH_HOLE),
     rays=[((8, 4), picture(0.125, 0.125)), ((30, 15), None), ((63, 31), None), ((63, 1), picture(63 / 64, 1 / 32))])
case("all_nan", "A map without a valid node is refused.", pfm([[(NAN, NAN, NAN)] * 2] * 2),
     error="no valid sample")

# A forward map of the picture's middle onto the whole display: nodes at the centres of their cells, y up, top row
# first. Node (i, j) of 4 x 4 lies at (i + 1/2) / 4 of the picture and lands at twice its distance from the middle.
FORWARD = [[(0.5 + 2 * ((x + 0.5) / 4 - 0.5), 0.5 + 2 * (0.5 - (y + 0.5) / 4), 0) for x in range(4)]
           for y in range(4)]
case("forward", "A forward map tells where nodes of the picture land, y from the bottom, top row first, nodes at the "
     "centres of their cells.", pfm(FORWARD), assume={"map_kind": "forward"},
     assumptions={"screen_y": "up", "row_order": "top_first", "node_alignment": "centers",
                  "interpolation": "triangles_alternating"},
     rays=[((0, 0), picture(0.25, 0.25)), ((64, 32), picture(0.75, 0.75)), ((16, 8), picture(0.375, 0.375))])
UPRIGHT_HALF = [[(0.1 + 0.8 * (x + 0.5) / 4, 0.9 - 0.8 * (y + 0.5) / 4, 0) for x in range(4)] for y in range(4)]
case("stereo_halves", "Two equal halves side by side are the forward maps of two eyes, and the left one is taken.",
     pfm([row + row for row in UPRIGHT_HALF]),
     assumptions={"stereo_half": "left", "map_kind": "forward"},
     rays=[((32, 16), picture(0.5, 0.5)), ((16, 16), picture(0.5 - 0.25 / 0.8, 0.5))])
OFFSET = [[(0.05, -0.1, NAN), (0.05, -0.1, NAN)], [(0.05, -0.1, NAN), (0.05, -0.1, NAN)]]
case("offsets", "Small numbers around zero are offsets of a forward mesh from the nodes' own places, y up.",
     pfm(OFFSET), assumptions={"map_kind": "forward", "map_values": "offset", "node_alignment": "corners"},
     rays=[((32, 16), picture(0.45, 0.4)), ((1, 16), None)])

# Points of a wall two metres ahead, four wide and two high: at the top left (-2, 1, -2).
WALL = [[(-2, -1, -2), (2, -1, -2)], [(-2, 1, -2), (2, 1, -2)]]
SEEN = [((0, 0), [-2, 1, -2]), ((64, 32), [2, -1, -2]), ((32, 16), [0, 0, -2])]


def scaled(rows, factor):
    return [[tuple(factor * c for c in node) for node in row] for row in rows]


case("surface", "Three channels of numbers are points, x right, y up, ahead -z; few metres make a wall.",
     pfm(WALL), assumptions={"map_kind": "surface", "units": "m", "axes": "x_right_y_up_z_back"}, rays=SEEN)
case("surface_millimetres", "Points thousands of units away are in millimetres.", pfm(scaled(WALL, 1000)),
     eye=[0, 0.5, 0], assumptions={"units": "mm"}, rays=[((0, 0), [-2, 0.5, -2]), ((64, 32), [2, -1.5, -2])])
case("surface_z_up", "Axes of surveyors: y ahead and z up.",
     pfm([[(x, -z, y) for x, y, z in row] for row in WALL]), assume={"axes": "x_right_y_ahead_z_up"}, rays=SEEN)
case("surface_x_left", "Axes with x left and z ahead.", pfm([[(-x, y, -z) for x, y, z in row] for row in WALL]),
     assume={"axes": "x_left_y_up_z_ahead"}, rays=SEEN)
case("surface_holes", "Points that are NaN or in the origin were not measured.",
     pfm([[(-2 + x, -1 + y, -2) if (x, y) not in ((0, 0), (4, 2)) else ((0, 0, 0) if x == 0 else (NAN, 1, -2))
           for x in range(5)] for y in range(3)]),
     rays=[((1, 31), None), ((63, 1), None), ((32, 16), [0, 0, -2])])
case("one_channel", "A map of one channel is none.",
     pfm([[(0.5,), (0.5,)], [(0.5,), (0.5,)]], channels=1), error="two or three channels")
case("one_row", "A map needs 2 x 2 nodes.", pfm([[(0, 0.5, 0), (1, 0.5, 0)]]), error="2 x 2 nodes")
case("truncated", "A file that ends before its numbers do is refused.", pfm(CORNERS)[:-1], error="bytes of numbers")
case("lying_size", "A header that promises more than there is is refused before memory is taken.",
     b"PF\n16384 16384\n-1.0\n" + struct.pack("<3f", 0, 0, 0), error="bytes of numbers")


def exr(rows):
    """Three float channels without compression; rows from the top."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    height, width = len(rows), len(rows[0])
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", window)
    header += attribute(b"displayWindow", b"box2i", window) + attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    line = 8 + 12 * width
    offsets = [len(header) + 8 * height + y * line for y in range(height)]
    data = b"".join(struct.pack("<2i", y, 12 * width) +
                    b"".join(struct.pack("<f", node[c]) for c in (2, 1, 0) for node in row)
                    for y, row in enumerate(rows))
    return header + struct.pack(f"<{height}Q", *offsets) + data


folder.write("surface_exr.exr", exr(WALL[::-1]))
folder.case("surface_exr", "An EXR holds points in R, G and B; its rows begin at the top.", "surface_exr.exr", size=SIZE,
            assumptions={"map_kind": "surface"}, rays=SEEN)
