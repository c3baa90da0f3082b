#!/usr/bin/env python3
# Writes the VIOSO warp files of this folder and what they stand for.
import os
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from closed_formulas import Folder, flat_ray, frustum_ray

folder = Folder(__file__)
POINTS, BORDER, SPLIT, ZIPPED, ENCRYPTED, LEVELS = 0x40, 0x8, 0x2, 0x1, 0x400, 0x20
SIZE = (4, 2)


def warp(records, flags=0, name="", size=SIZE, header_size=380, magic=b"vwf0", declared=None, black=(0, 0, 0)):
    """`records` from the top row, four numbers each."""
    data = struct.pack(f"<{4 * len(records)}f", *(number for record in records for number in record))
    reserved = [0.0] * 16
    reserved[9:12] = black
    header = (magic + struct.pack("<4I2i", header_size, flags, 7, len(data) if declared is None else declared, *size) +
              struct.pack("<4f4f", 1, 1, 1, 1, 0, 0, 0, 1) + struct.pack("<16f", *reserved) + name.encode().ljust(256, b"\0"))
    return header.ljust(header_size, b"\0")[:header_size] + data


def file(*blocks, count=None):
    return b"vwf1" + struct.pack("<3I", len(blocks) if count is None else count, 16, 0) + b"".join(blocks)


def bitmap(pixels, size=SIZE, bits=24, top_down=False):
    """One grey value, 0 to 1, a pixel, from the top row."""
    samples = 3 if bits in (24, 48, 96) else 4
    form, most = {1: ("B", 255), 2: ("H", 65535), 4: ("f", 1)}[bits // 8 // samples]
    rows = []
    for y in range(size[1]):
        values = [p * most if form == "f" else round(p * most) for p in pixels[y * size[0]:(y + 1) * size[0]] for _ in range(samples)]
        row = struct.pack(f"<{len(values)}{form}", *values)
        rows.append(row + b"\0" * (-len(row) % 4))
    data = b"".join(rows if top_down else rows[::-1])
    return (b"BM" + struct.pack("<IHHI", 54 + len(data), 0, 0, 54) +
            struct.pack("<IiiHHIIiiII", 40, size[0], -size[1] if top_down else size[1], 1, bits, 0, len(data), 0, 0, 0, 0) + data)


def case(name, rule, data, **keys):
    folder.write(name + ".vwf", data)
    folder.case(name, rule, name + ".vwf", **keys)


def uv(width=SIZE[0], height=SIZE[1], change=lambda x, y, record: record):
    """Every pixel shows the place where it is."""
    return [change(x, y, ((x + 0.5) / width, (y + 0.5) / height, 1, 0)) for y in range(height) for x in range(width)]


def media(u, v):
    return flat_ray(u, v, 90, 2)


SEEN = [((0.5, 0.5), media(0.125, 0.25)), ((0, 0), media(0, 0)), ((4, 2), media(1, 1))]
case("two_dimensional", "A warp tells which position of the content the centre of a pixel shows, v from the top; top row "
     "first.", file(warp(uv())), assumptions={"source": "perspective", "source_fov_deg": "90"}, rays=SEEN)
case("without_set", "A warp may come without a set's header.", warp(uv()), rays=SEEN)
case("later_headers", "Longer headers of later versions say more, and their size is read.",
     file(warp(uv(), header_size=5636, magic=b"vwf3")), rays=SEEN)
case("display_named", "Every warp of a set is a display, named as its header says.",
     file(warp(uv(), name="left"), warp(uv(change=lambda x, y, r: (r[0] / 2, r[1], 1, 0)), name="right")),
     display="right", rays=[((4, 1), media(0.5, 0.5))])
case("holes", "Records without a 1 in the third number are holes.",
     file(warp(uv(4, 4, lambda x, y, r: (r[0], r[1], 0 if (x, y) == (0, 0) else 1, 0)), size=(4, 4))),
     rays=[((0.6, 0.6), None), ((2.5, 2.5), flat_ray(0.625, 0.625, 90, 1))])
case("border", "With the border flag the content has a border of one per cent: u' = 1.02 u - 0.01.",
     file(warp(uv(), BORDER)), rays=[((0, 0), media(-0.01, -0.01)), ((2, 1), media(0.5, 0.5))])
case("split", "A part of a split display is a display of its own, with a warning.", file(warp(uv(), SPLIT)),
     warning="split display", rays=SEEN)


def wall(width=SIZE[0], height=SIZE[1]):
    """Two metres ahead, in millimetres: four metres wide and two high at its border."""
    return [(4000 * ((x + 0.5) / width - 0.5), 2000 * (0.5 - (y + 0.5) / height), -2000, 1) for y in range(height)
            for x in range(width)]


case("points", "With the flag of 3-D maps the records are points in millimetres, right-handed: x right, y up, ahead -z.",
     file(warp(wall(), POINTS)), assumptions={"axes": "x_right_y_up_z_back"},
     rays=[((0, 0), [-2, 1, -2]), ((4, 2), [2, -1, -2]), ((2, 1), [0, 0, -2])])
case("points_eye", "They are seen from the wall's eye.", file(warp(wall(), POINTS)), eye=[0.5, -0.25, 0],
     rays=[((0, 0), [-2.5, 1.25, -2])])
case("points_holes", "Points without a 1 in the fourth number are holes.",
     file(warp([(x, y, z, 0 if i == 0 else 1) for i, (x, y, z, _) in enumerate(wall(4, 4))], POINTS, size=(4, 4))),
     rays=[((0.6, 0.6), None), ((2, 2), [0, 0, -2])])
case("black_levels", "Factors of the black level that keep dark and bright colours are left out, with a warning.",
     file(warp(uv(), LEVELS, black=(1, 0.5, 0.5)), bitmap([1] * 8), bitmap([0.1] * 8)), warning="dark (0.5)", rays=SEEN)
case("white", "The third bitmap is not used, with a warning.",
     file(warp(uv()), bitmap([1] * 8), bitmap([], size=(0, 0)), bitmap([1] * 8)), warning="colour correction", rays=SEEN)
case("sixteen_bits", "Bitmaps have 24 to 128 bits a pixel, rows from either end.",
     file(warp(uv()), bitmap([0.5] * 8, bits=48, top_down=True)), assumptions={"intensity_gamma": "2.2"}, rays=SEEN)
case("empty_warp", "A warp without data makes no display.", file(warp([], name="none"), warp(uv(), name="some")),
     display="some", rays=SEEN)
case("only_empty", "A set of nothing else is refused.", file(warp([])), error="a warp with data")

INI = """[default]
calibFile=..\\Res\\view.vwf
eye=[0,0,0] ; in the program's units
[first]
calibIndex=1
[second]
calibIndex=0
dir=[10, 20, -5]
fov=[40,25,30,20] ;left, top, right, bottom
[third]
calibFile=points_host.vwf
bAutoView=1
base=[1000,0,0,0; 0,0,1000,0; 0,1000,0,0; 0,0,-1500,1] ; metres, x right, y up, z ahead, to millimetres with z up
eye=[0,0.5,0]
"""
folder.write("VIOSOWarpBlend.ini", INI)


def view(u, v):
    return frustum_ray(u, v, -40, 30, -20, 25, (20, 10, -5))


case("view", "VIOSOWarpBlend.ini beside the file tells what the content shows: pitch, yaw and roll, and the four angles.",
     file(warp(uv())), rays=[((0, 0), view(0, 0)), ((4, 2), view(1, 1)), ((0.5, 0.5), view(0.125, 0.25))])
# The program's (x, y, z ahead) in metres lies at (1000 x, 1000 z, 1000 y - 1500) of the file: the file's point
# (-2000, 2000, -500) is (-2, 1, 2) for the program, (-2, 1, -2) for us, half a metre above its eye.
case("points_host", "Its matrix leads from the program's axes and units to those of the points, and its eye is in those of "
     "the program.", file(warp([(x, -z, y - 1500, 1) for x, y, z, _ in wall()], POINTS)),
     rays=[((0, 0), [-2, 0.5, -2]), ((4, 2), [2, -1.5, -2])])

case("encrypted", "Encrypted warps are refused.", file(warp(uv(), ENCRYPTED)), error="not encrypted")
case("zipped", "Packed ones too.", file(warp(uv(), ZIPPED)), error="not packed")
case("truncated", "A file that ends early is refused.", file(warp(uv()))[:-1], error="bytes, found")
case("lying_size", "A size of the records that is not that of their number is refused.",
     file(warp(uv(), size=(16384, 16384))), error="bytes of records")
case("lying_records", "So are records that are not there, before memory is taken.",
     file(warp([], size=(8192, 8192), declared=1 << 30)), error="1073741824 bytes")
case("lying_blocks", "And blocks that are not there.", file(warp(uv()), count=3), error="the end of the file")
case("bitmap_first", "A bitmap belongs to the warp before it.", file(bitmap([1] * 8), warp(uv())), error="a warp")
case("bitmap_packed", "Bitmaps of other depths are refused.", file(warp(uv()), bitmap([1] * 8).replace(
    struct.pack("<HHI", 1, 24, 0), struct.pack("<HHI", 1, 8, 0))), error="bits a pixel")
