#!/usr/bin/env python3
# Writes the MPCDI files of this folder and what they stand for.
import io
import math
import os
import struct
import sys
import zipfile
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from closed_formulas import Folder, flat_ray, frustum_ray, pfm, rotation, turned

folder = Folder(__file__)
NAN = math.nan
SIZE = (64, 32)
ANGLES = (-30, 40, -20, 25)  # left, right, down, up
POSE = (50, 10, -20)         # yaw, pitch, roll


def png(rows):
    """Eight bits of grey."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    data = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def frustum(angles=ANGLES, pose=POSE):
    left, right, down, up = angles
    yaw, pitch, roll = pose
    return (f"<frustum><yaw>{yaw}</yaw><pitch>{pitch}</pitch><roll>{roll}</roll><rightAngle>{right}</rightAngle>"
            f"<leftAngle>{left}</leftAngle><upAngle>{up}</upAngle><downAngle>{down}</downAngle></frustum>")


def frame(position, yaw, pitch, roll):
    vectors = {"pos": position, "yaw": yaw, "pitch": pitch, "roll": roll}
    inside = "".join(f"<{name}{axis}>{value}</{name}{axis}>" for name, vector in vectors.items()
                     for axis, value in zip("xyz", vector))
    return f"<coordinateFrame>{inside}</coordinateFrame>"


Y_UP = ((0, -1, 0), (1, 0, 0), (0, 0, -1))
Z_UP = ((0, 0, -1), (1, 0, 0), (0, 1, 0))


def region(inside="", id="r", attributes=f'xResolution="{SIZE[0]}" yResolution="{SIZE[1]}" x="0" y="0" xsize="1" ysize="1"'):
    return f'<region id="{id}" {attributes}>{inside}</region>'


def fileset(inside, id="r"):
    return f'<fileset region="{id}">{inside}</fileset>'


def warp(path, more=""):
    return f"<geometryWarpFile><path>{path}</path>{more}</geometryWarpFile>"


def manifest(profile, regions, files="", extensions="", buffer='xResolution="64" yResolution="32"', version="2.0"):
    return (f'<?xml version="1.0" encoding="utf-8"?>\n<MPCDI profile="{profile}" geometry="1" color="1" '
            f'date="2024-01-01 00:00:00" version="{version}"><display><buffer id="b" {buffer}>{regions}</buffer></display>'
            f"<files>{files}</files>{extensions}</MPCDI>\n")


def archive(members):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as zip:
        for name, data in members.items():
            info = zipfile.ZipInfo(name, (2024, 1, 1, 0, 0, 0))
            info.compress_type = zipfile.ZIP_DEFLATED
            zip.writestr(info, data)
    return out.getvalue()


def zipped(name, rule, members, **keys):
    folder.write(name + ".mpcdi", archive(members))
    folder.case(name, rule, name + ".mpcdi", **keys)


def broken(name, rule, data, error):
    folder.write(name + ".mpcdi", data)
    folder.case(name, rule, name + ".mpcdi", error=error)


def bare(name, rule, xml, **keys):
    folder.write(name + ".mpcdi.xml", xml)
    folder.case(name, rule, name + ".mpcdi.xml", **keys)


def view(u, v):
    return frustum_ray(u, v, *ANGLES, POSE)


CORNERS = [((0, 0), view(0, 0)), ((64, 0), view(1, 0)), ((0, 32), view(0, 1)), ((16, 24), view(0.25, 0.75))]
PLAIN = manifest("3d", region(frustum()))

# Which file is the manifest.
zipped("manifest", "The manifest of an archive is mpcdi.xml.",
       {"other.xml": "<x/>", "mpcdi.xml": PLAIN}, rays=CORNERS)
zipped("manifest_mpacs", "Some writers call the manifest mpacs.xml.", {"other.xml": "<x/>", "mpacs.xml": PLAIN},
       rays=CORNERS)
zipped("manifest_other_name", "Else the only XML file is the manifest, with a byte order mark or without.",
       {"mpcdi_01.xml": b"\xef\xbb\xbf" + PLAIN.encode()}, rays=CORNERS)
zipped("manifest_ambiguous", "Of two XML files none is the manifest.", {"a.xml": PLAIN, "b.xml": PLAIN},
       error="or else one file *.xml")
zipped("manifest_missing", "An archive without a manifest is refused.", {"a.pfm": b""}, error="or else one file *.xml")
bare("bare_manifest", "A manifest on its own is a calibration too.", PLAIN, rays=CORNERS)
bare("letter_case", "Names of elements and attributes count in any letter case.",
     PLAIN.replace("rightAngle", "RightAngle").replace("xResolution", "Xresolution").replace("xsize", "xSize")
     .replace("MPCDI", "mpcdi").replace("frustum", "Frustum"), rays=CORNERS)
bare("display_named", "A display is named after its region.",
     manifest("3d", region(frustum()) + region(frustum(pose=(0, 0, 0)), id="s")), display="s",
     rays=[((0, 0), frustum_ray(0, 0, *ANGLES))])
bare("repeated_ids", "Where regions share an id, their buffers' ids come first.",
     manifest("3d", region(frustum()) + '</buffer><buffer id="c">' + region(frustum(pose=(0, 0, 0)))), display="c-r",
     rays=[((0, 0), frustum_ray(0, 0, *ANGLES))], warning="one buffer")
bare("buffer_resolution", "A region without a resolution has its buffer's, with a warning.",
     manifest("3d", region(frustum(), attributes="")), rays=CORNERS, warning="no resolution")

# Frusta.
bare("yaw_beyond_180", "Yaw may run from 0 to 360.", manifest("3d", region(frustum(pose=(410, 10, -20)))), rays=CORNERS)
bare("roll_raises_left", "A positive roll raises the left side of the picture.",
     manifest("3d", region(frustum((-45, 45, -45, 45), (0, 0, 90)), attributes='xResolution="32" yResolution="32"')),
     rays=[((0, 16), [0, 1, -1]), ((16, 0), [1, 0, -1])])
bare("angles_without_signs", "Left and down angles without their minus signs are seen by leaving no picture.",
     manifest("3d", region(frustum((30, 30, 20, 20), (0, 0, 0)))), assumptions={"angle_signs": "magnitudes"},
     rays=[((0, 0), frustum_ray(0, 0, -30, 30, -20, 20))])
bare("frustum_off_axis", "A positive left angle may be meant: the shape of the picture decides.",
     manifest("3d", region(frustum((10, 40, -9.2, 9.2), (0, 0, 0)))), assumptions={"angle_signs": "signed"},
     rays=[((0, 0), frustum_ray(0, 0, 10, 40, -9.2, 9.2))])
bare("angle_signs_given", "What the user says of the signs is taken.",
     manifest("3d", region(frustum((10, 40, -20, 20), (0, 0, 0)))), assume={"angle_signs": "magnitudes"},
     error="left below right")
bare("frustum_too_wide", "A frustum of 178 degrees and more is none.",
     manifest("3d", region(frustum((-89.8, 89.8, -20, 20)))), error="less than 178")
bare("frustum_flat", "A frustum without an area is none, however little its angles differ.",
     manifest("3d", region(frustum((6.16, 6.160000000000001, -20, 20), (0, 0, 0)))), error="an area")
bare("region_tiny", "A region of nearly nothing is no reason to fail.",
     manifest("2d", region(attributes='xResolution="64" yResolution="32" x="0" y="0" xsize="1e-300" ysize="1"'), buffer=""),
     error="covers an area")
bare("frustum_missing", "Profile 3d needs a frustum.", manifest("3d", region()), error="a frustum")
bare("profile_unknown", "Profiles are 2d, 3d, a3d and sl.", manifest("4d", region(frustum())), error="2d, 3d, a3d or sl")
bare("number_missing", "An angle that is no number is refused, with the place.",
     PLAIN.replace("<yaw>50", "<yaw>5O"), error="frustum/yaw: expected a finite number")

# Maps. PFM rows come from the bottom up.
PART = [[(0.1, 0.6, 0), (0.9, 0.6, 0)], [(0.1, 0.2, 0), (0.9, 0.2, 0)]]
FILES = fileset(warp("map.pfm"))
zipped("map_3d", "In profile 3d the map tells which position of the frustum's picture a pixel shows, v from the top.",
       {"mpcdi.xml": manifest("3d", region(frustum()), FILES), "map.pfm": pfm(PART)},
       assumptions={"map_values": "absolute", "row_order": "bottom_first", "source_v": "down",
                    "node_alignment": "corners", "interpolation": "bilinear"},
       rays=[((0, 0), view(0.1, 0.2)), ((64, 32), view(0.9, 0.6)), ((32, 16), view(0.5, 0.4))])
zipped("map_third_channel_nan", "Maps with NaN in the third channel, as Evans & Sutherland write them, begin with the "
       "top row and count v upwards.",
       {"mpcdi.xml": manifest("3d", region(frustum()), FILES),
        "map.pfm": pfm([[(u, v, NAN) for u, v, _ in row] for row in PART])},
       assumptions={"map_values": "absolute", "row_order": "top_first", "source_v": "up"},
       rays=[((0, 0), view(0.1, 0.4)), ((64, 32), view(0.9, 0.8))])
OFFSETS = [[(0.1, -0.05, NAN), (-0.1, -0.05, NAN)], [(0.1, 0.15, NAN), (-0.1, 0.15, NAN)]]
zipped("map_offsets", "Small numbers around zero are offsets: x' = i / (n - 1) + R and y' = 1 - j / (n - 1) + G, from "
       "the bottom left corner, for row j from the top, tell where the picture's nodes land.",
       {"mpcdi.xml": manifest("3d", region(frustum()), FILES), "map.pfm": pfm(OFFSETS)},
       assumptions={"map_values": "offset", "map_direction": "forward", "interpolation": "triangles"},
       # Columns land at 0.1 and 0.9, rows at 0.95 and 0.15 of the height.
       rays=[((19.2, 8), view(0.25, 0.25)), ((44.8, 20.8), view(0.75, 0.75)), ((32, 14.4), view(0.5, 0.5)),
             ((3, 16), None)])
zipped("map_zero_offsets", "A map of zeros is no offset anywhere.",
       {"mpcdi.xml": manifest("3d", region(frustum()), FILES), "map.pfm": pfm([[(0, 0, NAN)] * 3] * 3)},
       assumptions={"map_values": "offset"}, rays=CORNERS)
zipped("map_interpolation", "Keystone and smooth interpolation are read as linear, with a warning.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset(warp("map.pfm", "<interpolation>smooth</interpolation>"))),
        "map.pfm": pfm(PART)}, warning="read as linear", rays=[((0, 0), view(0.1, 0.2))])
zipped("fileset_outside_files", "A fileset counts anywhere below the root.",
       {"mpcdi.xml": manifest("3d", region(frustum())).replace("<files></files>", FILES), "map.pfm": pfm(PART)},
       rays=[((0, 0), view(0.1, 0.2))])
zipped("map_in_region", "A geometryWarpFile counts in its region too.",
       {"mpcdi.xml": manifest("3d", region(frustum() + warp("map.pfm"))), "map.pfm": pfm(PART)},
       rays=[((0, 0), view(0.1, 0.2))])
zipped("empty_elements", "Elements without a path are absent.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset(warp("") + "<alphaMap /><betaMap><path></path></betaMap>"))},
       rays=CORNERS)
zipped("path_in_folder", "Files are found by their exact path, and else by their bare name in any letter case.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset(warp("maps\\MAP.PFM"))), "data/map.pfm": pfm(PART)},
       rays=[((0, 0), view(0.1, 0.2))])
zipped("path_missing", "A map that is not there is an error, with the place.",
       {"mpcdi.xml": manifest("3d", region(frustum()), FILES)}, error="geometryWarpFile/path")
zipped("path_outside", "A path that leads out of the archive is refused.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset(warp("../map.pfm"))), "../map.pfm": pfm(PART)},
       error="inside of the archive")
zipped("path_absolute", "So is an absolute one.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset(warp("C:\\map.pfm"))), "map.pfm": pfm(PART)},
       error="inside of the archive")
zipped("alpha_resampled", "An alpha map of another size is resampled, with a warning.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset("<alphaMap><path>a.png</path><gammaEmbedded>2.2"
                                                              "</gammaEmbedded></alphaMap>")),
        "a.png": png([[0, 255], [0, 255]])}, warning="resampled", rays=CORNERS)
bare("alpha_required", "MPCDI 1.0 demands an alpha map; without one there is a warning.",
     manifest("3d", region(frustum()), version="1.0"), warning="needs an alphaMap", rays=CORNERS)
zipped("lookup_tables", "Colour tables of 2.0 are not used, with a warning.",
       {"mpcdi.xml": manifest("3d", region(frustum()), fileset("<decodeLUT><path>a.cube</path></decodeLUT>"))},
       warning="decodeLUT is not used", rays=CORNERS)

# Profile 2d: the buffer is a flat picture 90 degrees wide unless something else is known.
PLACED = 'xResolution="64" yResolution="32" x="0.25" y="0.5" xsize="0.5" ysize="0.25"'


def media(u, v):
    return flat_ray(u, v, 90, 2)


zipped("region_2d", "In profile 2d a region without a map shows its rectangle of the buffer, from the top left corner.",
       {"mpcdi.xml": manifest("2d", region(attributes=PLACED))},
       assumptions={"source": "perspective", "source_fov_deg": "90"},
       rays=[((0, 0), media(0.25, 0.5)), ((64, 32), media(0.75, 0.75)), ((32, 16), media(0.5, 0.625))])
zipped("map_2d", "With a map it shows positions within that rectangle.",
       {"mpcdi.xml": manifest("2d", region(attributes=PLACED), FILES), "map.pfm": pfm(PART)},
       rays=[((0, 0), media(0.25 + 0.1 / 2, 0.5 + 0.2 / 4)), ((64, 32), media(0.25 + 0.9 / 2, 0.5 + 0.6 / 4))])
bare("source_given", "What the buffer shows may be given.", manifest("2d", region(attributes=PLACED)),
     source={"size": [400, 100], "projection": {"type": "equirectangular", "horizontal_fov_deg": 360,
                                                "vertical_fov_deg": 90}},
     rays=[((32, 0), [0, 0, -1]), ((0, 0), [-1, 0, 0])])
bare("region_outside", "A region beyond its buffer breaks a rule, with a warning.",
     manifest("2d", region(attributes='xResolution="64" yResolution="32" x="0.5" y="0" xsize="1" ysize="1"')),
     warning="outside of its buffer", rays=[((0, 0), media(0.5, 0))])

# Profile a3d: points, here of a wall two metres ahead.
WALL = [[(-2, -1, -2), (2, -1, -2)], [(-2, 1, -2), (2, 1, -2)]]


def points(rows):
    return {"mpcdi.xml": None, "map.pfm": pfm(rows)}


def surface(name, rule, rows, more, profile="a3d", inside="", **keys):
    files = fileset(warp("map.pfm", more))
    zipped(name, rule, {"mpcdi.xml": manifest(profile, region(inside), files), "map.pfm": pfm(rows)}, **keys)


METRES = "<geometricUnit>m</geometricUnit><originOf3DData>idealEyePoint</originOf3DData>"
surface("points", "In profile a3d the map holds the points that pixels light: x right, y up, ahead -z.", WALL, METRES,
        assumptions={"axes": "x_right_y_up_z_back", "row_order": "bottom_first"},
        rays=[((0, 0), [-2, 1, -2]), ((64, 32), [2, -1, -2])])
surface("points_units", "geometricUnit is their unit.",
        [[tuple(c / 0.3048 for c in node) for node in row] for row in WALL], METRES.replace(">m<", ">ft<"),
        eye=[0, 1, 0], rays=[((0, 0), [-2, 0, -2]), ((64, 32), [2, -2, -2])])
surface("points_floor", "With another origin than the ideal eye point and no eye given, a warning says where it is.",
        WALL, METRES.replace("idealEyePoint", "floorCenter"), warning="no eye is given", rays=[((0, 0), [-2, 1, -2])])
surface("points_frame", "A coordinateFrame names the axes: pitch to the right, roll ahead, yaw down.",
        [[(x, -z, y) for x, y, z in row] for row in WALL], METRES, inside=frame((0, 0, 0), *Z_UP),
        rays=[((0, 0), [-2, 1, -2]), ((64, 32), [2, -1, -2])])
surface("points_sl", "In profile sl the points are of the surface too, seen from the wall's eye.",
        [[(x, -z, y) for x, y, z in row] for row in WALL], METRES, profile="sl", eye=[1, 0, 0],
        inside=frustum() + frame((5, -3, 2), *Z_UP), rays=[((0, 0), [-3, 1, -2]), ((64, 32), [1, -1, -2])])
bare("points_missing", "Profile a3d is nothing without points.", manifest("a3d", region()), error="points of profile a3d")
bare("frame_skewed", "Axes that are not at right angles are refused.",
     manifest("sl", region(frustum() + frame((0, 0, 0), (0, 0, -1), (1, 0, 0), (0.6, 0.8, 0)))), error="right angles")

# Projectors without points.
bare("projector", "Without points a projector shows what its frustum does, at infinity; its position is left out, with a "
     "warning that names it in the wall's axes.",
     manifest("sl", region(frustum() + frame((1, -2, 3), *Z_UP))), warning="(1, 3, 2) is left out", rays=CORNERS)
bare("projector_3d", "So in profile 3d with a coordinateFrame.",
     manifest("3d", region(frustum() + frame((1, 2, 3), *Y_UP))), warning="(1, 2, 3) is left out", rays=CORNERS)
zipped("distortion", "A distortionMap of profile sl is an inverse map of the frustum's picture.",
       {"mpcdi.xml": manifest("sl", region(frustum() + frame((0, 0, 0), *Z_UP)),
                              fileset("<distortionMap><path>map.pfm</path></distortionMap>")), "map.pfm": pfm(PART)},
       rays=[((0, 0), view(0.1, 0.2)), ((64, 32), view(0.9, 0.6))])

# Christie's fisheye extension.


def fisheye(coefficients, offset=(0, 0), more="", inside=frustum((89.8, 89.8, 89.8, 89.8))):
    terms = "".join(f"<{name}>{value}</{name}>" for name, value in coefficients.items())
    extension = ('<extensionSet><extension Name="BufferExtension" hasExternalFiles="false"><buffer id="b"><region id="r">'
                 f"<fisheye><horizontalOffset>{offset[0]}</horizontalOffset><verticalOffset>{offset[1]}</verticalOffset>"
                 f"{terms}</fisheye>{more}</region></buffer></extension></extensionSet>")
    return manifest("sl", region(inside), extensions=extension)


def off_axis(angle, direction):
    """`angle` radians off the axis, towards the right (0) or up (90 degrees)."""
    d = math.radians(direction)
    return turned(rotation(*POSE), [math.sin(angle) * math.cos(d), math.sin(angle) * math.sin(d), -math.cos(angle)])


bare("fisheye", "The fisheye extension tells the radius, in half widths, of a ray t radians off the axis as f1 t + f3 t^3 "
     "+ ...; the frustum's angles stand for nothing then.", fisheye({"f1": 0.8, "f3": -0.02}),
     assumptions={"fisheye_units": "half_widths"}, warning="angles are not used",
     rays=[((32 + 32 * (0.8 - 0.02), 16), off_axis(1, 0)), ((32, 16 - 32 * (0.4 - 0.0025)), off_axis(0.5, 90)),
           ((32, 16), off_axis(0, 0))])
bare("fisheye_percent", "Coefficients around a hundred are percent of half the width.", fisheye({"f1": 75}),
     assumptions={"fisheye_units": "percent"}, rays=[((32 + 24, 16), off_axis(1, 0))])
bare("fisheye_units_given", "The user may say that they are pixels.", fisheye({"f1": 20}), assume={"fisheye_units": "pixels"},
     rays=[((52, 16), off_axis(1, 0))])
bare("fisheye_offset", "Offsets shift the picture off the axis, in half widths to the right and half heights up.",
     fisheye({"f1": 0.8}, offset=(0.25, 0.5)), rays=[((24, 24), off_axis(0, 0)), ((24 + 25.6, 24), off_axis(1, 0))])
bare("anamorphic", "An anamorphic ratio is the height of a pixel over its width.",
     fisheye({"f1": 0.4}, more="<anamorphic><ratio>1.25</ratio></anamorphic>"),
     rays=[((32 + 12.8, 16), off_axis(1, 0)), ((32, 16 - 10.24), off_axis(1, 90))])
bare("anamorphic_angle", "A turned anamorphic lens is left out, with a warning.",
     fisheye({"f1": 0.8}, more="<anamorphic><angle>3</angle></anamorphic>"), warning="is left out",
     rays=[((32 + 25.6, 16), off_axis(1, 0))])
bare("fisheye_falling", "A radius that does not grow is refused.", fisheye({"f1": -1}), error="a radius that grows")

# What nobody should write.
bare("doctype", "A document type may name files anywhere, and is refused.",
     PLAIN.replace("<MPCDI", "<!DOCTYPE MPCDI [<!ENTITY x SYSTEM 'file:///etc/hostname'>]><MPCDI"), error="DOCTYPE")
bare("deep", "So are more than 64 levels.", "<MPCDI>" + "<a>" * 2000 + "</a>" * 2000 + "</MPCDI>", error="64 levels")
broken("truncated", "An archive that ends early is refused.", archive({"mpcdi.xml": PLAIN})[:-30], "a ZIP archive")


def patched(members, offset, value, form="<I"):
    """The archive with a number of its first central directory entry changed."""
    data = bytearray(archive(members))
    at = data.index(b"PK\x01\x02") + offset
    data[at:at + struct.calcsize(form)] = struct.pack(form, value)
    return bytes(data)


broken("declared_huge", "Members of more than any calibration needs are refused before they are unpacked.",
       patched({"mpcdi.xml": PLAIN}, 24, 0xF0000000), "together")
broken("declared_small", "A member that unpacks to more than the archive states is refused.",
       patched({"mpcdi.xml": PLAIN}, 24, 100), "as the archive states")
encrypted = bytearray(patched({"mpcdi.xml": PLAIN}, 8, 1, "<H"))
encrypted[6] |= 1
broken("encrypted", "An encrypted member is refused.", bytes(encrypted), "not encrypted")
broken("packing", "Members packed in another way than deflate are refused.",
       patched({"mpcdi.xml": PLAIN}, 10, 93, "<H"), "packed by deflate")
