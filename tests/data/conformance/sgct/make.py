#!/usr/bin/env python3
"""Writes this folder: configurations of SGCT, the files that they name, and what they mean.

The rays follow SGCT's own sources step by step: the cameras of the faces of its cubes, the shaders that look
the cubes up, the frustum through the corners of a screen.
"""
import json
import math
import os
import struct
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))


# Vectors and matrices ------------------------------------------------------------------------------------

def times(m, v):
    return [sum(m[r][c] * v[c] for c in range(3)) for r in range(3)]


def product(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(3)) for c in range(3)] for r in range(3)]


def about(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return {'x': [[1, 0, 0], [0, c, -s], [0, s, c]],
            'y': [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            'z': [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]


def turned(yaw=0, pitch=0, roll=0):
    return product(product(about('y', -yaw), about('x', pitch)), about('z', -roll))


def tan(degrees):
    return math.tan(math.radians(degrees))


IDENTITY = turned()


# What SGCT sees ------------------------------------------------------------------------------------------

def in_cube(cube, r):
    """Towards a texture coordinate of the cube: the table of cube map faces, and the camera of that face."""
    x, y, z = r
    if abs(x) >= abs(y) and abs(x) >= abs(z):
        face = product(cube, about('y', -90 if x > 0 else 90))
        sc, tc, ma = (-z if x > 0 else z), -y, abs(x)
    elif abs(y) >= abs(z):
        face = product(cube, about('x', -90 if y > 0 else 90))
        sc, tc, ma = x, (z if y > 0 else -z), abs(y)
    else:
        face = cube if z > 0 else product(cube, about('y', 180))
        sc, tc, ma = (x if z > 0 else -x), -y, abs(z)
    return times(face, [sc / ma, tc / ma, -1])


UPRIGHT = product(about('x', 90), about('z', 45))


def cylinder(s, t, rotation=0, height=0):
    angle = -2 * math.pi * s + math.radians(rotation)
    return in_cube(UPRIGHT, [math.cos(angle), math.sin(angle), t + height])


def equirectangular(s, t):
    phi, theta = math.pi * (1 - t), 2 * math.pi * (s - 0.5)
    return in_cube(UPRIGHT, [math.sin(phi) * math.sin(theta), math.sin(phi) * math.cos(theta), math.cos(phi)])


def fisheye(s, t, fov=180, tilt=0, offset=(0, 0, 0)):
    """With four faces; the other layout of faces sees the same."""
    s, t = 2 * (s - 0.5), 2 * (t - 0.5)
    if math.hypot(s, t) > 1:
        return None
    phi, theta = math.hypot(s, t) * math.radians(fov) / 2, math.atan2(s, t)
    d = [math.sin(phi) * math.sin(theta) - offset[0], -math.sin(phi) * math.cos(theta) - offset[1],
         math.cos(phi) - offset[2]]
    a = math.sqrt(0.5)
    cube = product(about('x', 90 - tilt), about('y', 45))
    return in_cube(cube, [a * d[0] + a * d[2], d[1], -a * d[0] + a * d[2]])


def planar(s, t, left, right, down, up, rotation=IDENTITY, distance=10, offset=(0, 0, 0), eye=(0, 0, 0)):
    """The angles as the configuration has them: magnitudes to all four sides."""
    x = -tan(left) + s * (tan(right) + tan(left))
    y = -tan(down) + t * (tan(up) + tan(down))
    point = times(rotation, [distance * x, distance * y, -distance])
    return [point[i] + offset[i] - eye[i] for i in range(3)]


def plane(s, t, ll, ul, ur, eye):
    return [ul[i] + s * (ur[i] - ul[i]) + (1 - t) * (ll[i] - ul[i]) - eye[i] for i in range(3)]


# Files ---------------------------------------------------------------------------------------------------

def write(name, content):
    with open(os.path.join(HERE, name), 'wb') as out:
        out.write(content if isinstance(content, bytes) else content.encode())


def png(width, height, grey):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + bytes(grey[y * width:(y + 1) * width]) for y in range(height))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 0, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def pfm(width, height, values):
    """Values in the order of the file, which SGCT begins at the top."""
    return b'PF\n%d %d\n-1.0\n' % (width, height) + b''.join(struct.pack('<3f', *v, 0) for v in values)


def sgc(up, down, left, right):
    """One square that shows the whole picture on the whole screen."""
    vertices = b''.join(struct.pack('<6f', x, y, 0, x, 1 - y, 0) for y in (0, 1) for x in (0, 1))
    return (b'SGC\x01' + struct.pack('<I', 0) + struct.pack('<11f', 0, 0, 0, 1, 0, 0, 0, up, down, left, right) +
            struct.pack('<2I', 2, 2) + vertices + struct.pack('<5I', 4, 0, 2, 1, 3))


def obj(left, bottom, right, top, is_flipped=False):
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    text = ''.join('v %g %g 0\n' % (left + u * (right - left), bottom + v * (top - bottom)) for u, v in corners)
    text += ''.join('vt %g %g\n' % (u, 1 - v if is_flipped else v) for u, v in corners)
    return text + 'f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n'


def bourke(aspect):
    return '2\n2 2\n' + ''.join('%g %g %g %g 1\n' % (x * aspect, y, (x + 1) / 2, (y + 1) / 2)
                                for y in (-1, 1) for x in (-1, 1))


# Configurations ------------------------------------------------------------------------------------------

W, H = 64, 32


def vector(v):
    return dict(zip('xyz', v))


def config(viewports, window=None, users=None):
    windows = [{'size': {'x': W, 'y': H}, 'viewports': viewports, **(window or {})}]
    return {'version': 1, 'masteraddress': 'localhost',
            'nodes': [{'address': 'localhost', 'port': 20401, 'windows': windows}],
            'users': users or [{'eyeseparation': 0.06, 'pos': vector([0, 0, 0])}]}


def projected(kind, **keys):
    more = {k: keys.pop(k) for k in list(keys) if k in ('mesh', 'blendmask', 'blacklevelmask', 'overlay', 'eye')}
    return {'projection': {'type': kind, **keys}, **more}


def square(**more):
    return projected('PlanarProjection', fov={'hfov': 90, 'vfov': 90}, **more)


def seen(st, ray, width=W, height=H):
    """s and t are fractions from the bottom left."""
    return {'px': [st[0] * width, (1 - st[1]) * height],
            'ray': ray if ray is None else [round(x, 15) for x in ray]}


def case(rule_name, rule, configuration, points=(), see=None, **more):
    is_xml = isinstance(configuration, str)
    name = rule_name + ('.xml' if is_xml else '.sgct.json')
    write(name, configuration if is_xml else json.dumps(configuration, indent=1) + '\n')
    content = {'rule': rule, 'file': name}
    content.update({k: v for k, v in more.items() if k not in ('width', 'height')})
    if points:
        size = (more.get('width', W), more.get('height', H))
        content['rays'] = [seen(p, see(*p), *size) for p in points]
    write(rule_name + '.json', json.dumps(content, indent=1) + '\n')


CORNERS = [(0, 0), (1, 1), (0.25, 0.75)]
ANGLES = {'left': 30, 'right': 40, 'down': 10, 'up': 20}


def planar_cases():
    case('planar_whole_angles', 'hfov and vfov are whole angles, half to each side',
         config([projected('PlanarProjection', fov={'hfov': 80, 'vfov': 50})]), CORNERS,
         lambda s, t: planar(s, t, 40, 40, 25, 25))
    case('planar_sides', 'left, right, down and up are angles to each side, all positive where the axis is inside',
         config([projected('PlanarProjection', fov=ANGLES)]), CORNERS, lambda s, t: planar(s, t, 30, 40, 10, 20))
    case('planar_side_beats_whole', 'the angle of one side counts where the whole angle is given too',
         config([projected('PlanarProjection', fov={'hfov': 80, 'vfov': 50, 'left': 10})]), CORNERS,
         lambda s, t: planar(s, t, 10, 40, 25, 25))
    case('planar_negative_down', 'a negative angle down means that the lower border is above the axis',
         config([projected('PlanarProjection', fov={**ANGLES, 'down': -7.7})]), CORNERS,
         lambda s, t: planar(s, t, 30, 40, -7.7, 20))
    case('planar_yaw_pitch_roll', 'yaw turns right, pitch up, roll clockwise, applied in this order by the viewer',
         config([projected('PlanarProjection', fov=ANGLES, orientation={'yaw': 30, 'pitch': 20, 'roll': 10})]),
         CORNERS, lambda s, t: planar(s, t, 30, 40, 10, 20, turned(30, 20, 10)))
    half = math.radians(50) / 2
    case('planar_quaternion', 'an orientation may be a right-handed quaternion',
         config([projected('PlanarProjection', fov=ANGLES,
                           orientation={'x': math.sin(half), 'y': 0, 'z': 0, 'w': math.cos(half)})]),
         CORNERS, lambda s, t: planar(s, t, 30, 40, 10, 20, about('x', 50)))
    user = [{'pos': vector([0, 0, 4])}]
    case('planar_distance_by_default', 'the screen stands 10 m from the origin, not from the user',
         config([projected('PlanarProjection', fov=ANGLES)], users=user), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, eye=[0, 0, 4]), eye=[0, 0, 4],
         assumptions={'distance_m': '10'})
    case('planar_distance', 'or at the distance that is given',
         config([projected('PlanarProjection', fov=ANGLES, distance=2.5)], users=user), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, distance=2.5, eye=[0, 0, 4]), eye=[0, 0, 4])
    offset = [0.5, -0.25, 1]
    case('planar_offset', 'an offset shifts the screen in the axes of the world, after its orientation',
         config([projected('PlanarProjection', fov=ANGLES, distance=2, offset=vector(offset),
                           orientation={'yaw': 90, 'pitch': 0, 'roll': 0})]), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, turned(90), 2, offset))
    case('planar_incomplete', 'angles must be given for all four sides',
         config([projected('PlanarProjection', fov={'hfov': 80})]), error='fov.down: expected a number, or vfov')
    case('planar_inside_out', 'the left border must be left of the right one',
         config([projected('PlanarProjection', fov={'hfov': -80, 'vfov': 50})]),
         error='a screen that the eye can see')


def plane_cases():
    ll, ul, ur, eye = [-1, -1, 0.5], [-1.2, 1, 0.25], [1.5, 1.1, -1], [0.1, 0.2, 2]
    case('projection_plane', 'a projection plane is a screen, by three corners, that the user sees from where he is',
         config([projected('ProjectionPlane', lowerleft=vector(ll), upperleft=vector(ul), upperright=vector(ur))],
                users=[{'pos': vector(eye)}]), CORNERS, lambda s, t: plane(s, t, ll, ul, ur, eye))
    case('eye_of_the_wall', 'the wall may have its eye elsewhere than the user of the file',
         config([projected('ProjectionPlane', lowerleft=vector(ll), upperleft=vector(ul), upperright=vector(ur))],
                users=[{'pos': vector(eye)}]), CORNERS, lambda s, t: plane(s, t, ll, ul, ur, [0, 0, 3]),
         eye=[0, 0, 3], warning='the eye (0, 0, 3) was asked for')
    case('eye_of_the_file', "the wall's eye is the user's where nobody says otherwise",
         config([projected('PlanarProjection', fov=ANGLES)], users=[{'pos': vector([0, 0, 4])}]), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, eye=[0, 0, 4]), assumptions={'distance_m': '10'})
    case('no_projection', 'a viewport without a projection shows a square of 2 x 2 m at a distance of 2 m',
         config([{}]), CORNERS, lambda s, t: plane(s, t, [-1, -1, -2], [-1, 1, -2], [1, 1, -2], [0, 0, 0]))
    named = config([projected('ProjectionPlane', lowerleft=vector(ll), upperleft=vector(ul), upperright=vector(ur))],
                   users=[{'pos': vector([0, 0, 9])}, {'name': 'guest', 'pos': vector(eye)}])
    named['nodes'][0]['windows'][0]['viewports'][0]['user'] = 'guest'
    case('named_user', 'a viewport may name its user', named, CORNERS, lambda s, t: plane(s, t, ll, ul, ur, eye))


def fisheye_cases():
    inside = [(0.5, 0.5), (0.5, 0.01), (0.6, 0.8)]

    def centred(see):  # the circle fills the height of the window
        return lambda s, t: see(0.5 + (s - 0.5) * W / H, t)
    case('fisheye', 'the middle of a fisheye is the zenith, ahead is at its bottom; the angle grows evenly from the '
         'middle, and the circle is the largest that fits', config([projected('FisheyeProjection', fov=170)]),
         inside + [(0.2, 0.5)], centred(lambda s, t: fisheye(s, t, 170)))
    case('fisheye_tilt', 'with a tilt of 90 degrees the middle is ahead',
         config([projected('FisheyeProjection', tilt=90)]), inside, centred(lambda s, t: fisheye(s, t, tilt=90)))
    case('fisheye_wide', 'a fisheye may show more than a hemisphere',
         config([projected('FisheyeProjection', fov=240, tilt=27)]), inside,
         centred(lambda s, t: fisheye(s, t, 240, 27)))
    case('fisheye_stretched', 'without keepaspectratio the circle is stretched over the viewport',
         config([projected('FisheyeProjection', keepaspectratio=False)]), inside, fisheye)
    case('fisheye_crop', 'what a crop leaves of the square fills the viewport as far as its shape allows',
         config([projected('FisheyeProjection', crop={'left': 0, 'right': 0, 'bottom': 0.5, 'top': 0})]),
         [(0.5, 0.001), (0.25, 0.5), (0.999, 0.999)], lambda s, t: fisheye(s, 0.5 + 0.5 * t))
    case('fisheye_crop_narrow', 'nothing is shown beside what a crop leaves',
         config([projected('FisheyeProjection', crop={'left': 0.25, 'right': 0.25, 'bottom': 0, 'top': 0})]),
         [(0.5, 0.5), (0.4, 0.9), (0.3, 0.5)],
         lambda s, t: fisheye(0.5 + (s - 0.5) * W / H, t) if abs(s - 0.5) <= 0.125 else None)
    offset = [0.25, -0.5, 0.125]
    case('fisheye_offset', 'an offset, in radii of the dome, moves the eye in the axes of the shader: x right, y '
         'down, z ahead', config([projected('FisheyeProjection', offset=vector(offset), tilt=20)]), inside,
         centred(lambda s, t: fisheye(s, t, tilt=20, offset=offset)))


def other_projection_cases():
    points = [(0.125, 0.25), (0.5, 0.5), (0.9, 0.75)]
    case('cylinder', 'a cylinder begins 135 degrees to the right of ahead and turns right; it shows the heights from '
         'the eye to one radius above', config([projected('CylindricalProjection')]), points, cylinder,
         assumptions={'sgct_convention': 'program'})
    case('cylinder_rotation', 'its rotation, in degrees, turns what is seen to the left, its height offset lifts it '
         'in radii', config([projected('CylindricalProjection', rotation=30, heightoffset=-0.5)]), points,
         lambda s, t: cylinder(s, t, 30, -0.5))

    def documented(s, t):
        heading = 2 * math.pi * s - 0.5
        return [math.sin(heading), t, -math.cos(heading)]
    case('cylinder_documentation', 'by its documentation a cylinder begins ahead, and the rotation is in radians',
         config([projected('CylindricalProjection', rotation=0.5)]), points, documented,
         assume={'sgct_convention': 'documentation'})
    case('equirectangular', 'the middle of an equirectangular picture looks 45 degrees to the right of ahead',
         config([projected('EquirectangularProjection')]), points, equirectangular,
         assumptions={'sgct_convention': 'program'})

    def level(s, t):
        longitude, latitude = 2 * math.pi * (s - 0.5), math.pi * (t - 0.5)
        return [math.cos(latitude) * math.sin(longitude), math.sin(latitude),
                -math.cos(latitude) * math.cos(longitude)]
    case('equirectangular_documentation', 'or ahead, as pictures of this kind do',
         config([projected('EquirectangularProjection')]), points, level,
         assume={'sgct_convention': 'documentation'})
    case('cube_face', 'a cube is six displays of the size that quality says; the one named front looks ahead',
         config([projected('CubemapProjection', quality='low')]), [(0, 0), (0.75, 0.5)],
         lambda s, t: [2 * s - 1, 2 * t - 1, -1], width=256, height=256, display='cube_face.sgct-front')
    case('cube_face_above', 'its top face has ahead at its bottom',
         config([projected('CubemapProjection', quality='low')]), [(0, 0), (0.75, 0.5)],
         lambda s, t: times(about('x', 90), [2 * s - 1, 2 * t - 1, -1]), width=256, height=256,
         display='cube_face_above.sgct-top')
    case('unknown_projection', 'a projection that is not known is no reason to guess',
         config([projected('HolographicProjection')]), error='found "HolographicProjection"')


def mesh_cases():
    write('flipped.obj', obj(-1, -1, 1, 1, True))
    case('mesh', 'a mesh bends the picture of the viewport; files are found by their bare name',
         config([square(mesh='C:/SGCT/config/flipped.obj')]), CORNERS, lambda s, t: planar(s, 1 - t, 45, 45, 45, 45))
    write('wall.sgc', sgc(30, -10, -45, 45))
    case('sgc_frustum', "the frustum of an .sgc mesh counts, not the configuration's", config([square(mesh='wall.sgc')]),
         CORNERS, lambda s, t: planar(s, t, 45, 45, 10, 30), warning='up 30.000 instead of 45.000 degrees')
    write('both_eyes.pfm', pfm(4, 2, [(0.25, 0.875), (0.75, 0.875), (0, 0), (0, 0),
                                      (0.25, 0.375), (0.75, 0.375), (0, 0), (0, 0)]))
    # The picture lies an eighth of the screen higher than without the mesh.
    case('pfm_forward', 'a PFM on a planar projection holds maps of two eyes side by side, from the top: where the '
         'centres of the texels of the picture land on the screen, y up; the left one is drawn',
         config([square(mesh='both_eyes.pfm')]), [(0.25, 0.875), (0.75, 0.375), (0.5, 0.625), (0.9, 0.9)],
         lambda s, t: planar(s, t - 0.125, 45, 45, 45, 45) if s < 0.8 else None)
    write('left_half.pfm', pfm(2, 2, [(0, 1), (0.5, 1), (0, 0), (0.5, 0)]))
    case('pfm_inverse', 'a PFM on a texture mapped projection holds positions in the picture, y up, for nodes on the '
         'screen from its top left corner to its bottom right one',
         config([projected('TextureMappedProjection', fov={'hfov': 90, 'vfov': 90}, mesh='left_half.pfm')]), CORNERS,
         lambda s, t: planar(s / 2, t, 45, 45, 45, 45))
    both = config([square(mesh='both_eyes.pfm')])
    case('pfm_forward_listed', 'what SGCT takes for granted in such a map is listed', both, [(0.25, 0.875)],
         lambda s, t: planar(s, t - 0.125, 45, 45, 45, 45),
         assumptions={'map_direction': 'forward', 'stereo_half': 'left', 'map_values': 'absolute', 'screen_y': 'up',
                      'row_order': 'top_first', 'node_alignment': 'centers',
                      'interpolation': 'triangles_alternating'})
    case('pfm_forward_other_rows', 'and may be overruled: with its first row at the bottom, y down, the picture is '
         'turned over', both, [(0.25, 0.125), (0.75, 0.625)], lambda s, t: planar(s, t + 0.125, 45, 45, 45, 45),
         assume={'row_order': 'bottom_first', 'screen_y': 'down'})
    case('pfm_forward_upside_down', 'an order of rows that the numbers contradict is worth a warning', both,
         [(0.25, 0.875)], lambda s, t: planar(s, 0.25, 45, 45, 45, 45),
         assume={'row_order': 'bottom_first'}, warning='shows its picture upside down')
    write('right_eye.pfm', pfm(4, 2, [(0, 0), (0, 0), (0.25, 0.875), (0.75, 0.875),
                                      (0, 0), (0, 0), (0.25, 0.375), (0.75, 0.375)]))
    case('pfm_forward_right', 'the right half of such a map may be asked for', config([square(mesh='right_eye.pfm')]),
         [(0.25, 0.875), (0.75, 0.375)], lambda s, t: planar(s, t - 0.125, 45, 45, 45, 45),
         assume={'stereo_half': 'right'})
    case('pfm_forward_corners', 'nodes may lie on the borders of the picture',
         both, [(0.25, 0.875), (0.75, 0.375)],
         lambda s, t: planar((s - 0.25) * 2, (t - 0.375) * 2, 45, 45, 45, 45), assume={'node_alignment': 'corners'})
    listed = config([projected('TextureMappedProjection', fov={'hfov': 90, 'vfov': 90}, mesh='left_half.pfm')])
    case('pfm_inverse_listed', 'of an inverse map it is listed, too', listed, [(0, 0)],
         lambda s, t: planar(s / 2, t, 45, 45, 45, 45),
         assumptions={'map_direction': 'inverse', 'stereo_half': 'none', 'map_values': 'absolute', 'source_v': 'up',
                      'row_order': 'top_first', 'node_alignment': 'corners', 'interpolation': 'bilinear'})
    case('pfm_inverse_other_rows', 'and may be overruled', listed, [(0, 0), (0.5, 0.25)],
         lambda s, t: planar(s / 2, 1 - t, 45, 45, 45, 45), assume={'source_v': 'down'},
         warning='shows its picture upside down')
    case('texture_mapped_without_map', 'a texture mapped projection needs its map',
         config([projected('TextureMappedProjection', fov={'hfov': 90, 'vfov': 90})]),
         error='expected the map of a TextureMappedProjection')
    write('square.data', bourke(1))
    case('bourke', "a Bourke mesh keeps its shape on a window of another, and the fisheye's circle fills its picture",
         config([projected('FisheyeProjection', mesh='square.data')]), [(0.5, 0.5), (0.6, 0.3), (0.2, 0.5)],
         lambda s, t: fisheye(0.5 + (s - 0.5) * W / H, t), warning='made for a screen 1.0000 times as wide as high')
    for name, left, bottom in (('bottom', -0.5, -1), ('left', -1.5, -1), ('right', 0.5, -1), ('top', -0.5, -0.25)):
        write(name + '.obj', obj(left, bottom, left + 1, bottom + 1))

    def mirror(s, t):
        """The screen is 4 x 2 units about its middle; what is drawn last is on top."""
        x, y = 4 * s - 2, 2 * t - 1
        for left, bottom, face in ((-0.5, -0.25, about('x', 90)), (0.5, -1, about('y', -90)),
                                   (-1.5, -1, about('y', 90)), (-0.5, -1, IDENTITY)):
            if left <= x <= left + 1 and bottom <= y <= bottom + 1:
                seen_on_face = times(face, [2 * (x - left) - 1, 2 * (y - bottom) - 1, -1])
                return times(about('x', 45 - 20), seen_on_face)
        return None
    case('spherical_mirror', 'the four meshes of a spherical mirror take from the faces ahead (bottom), to the left, '
         'to the right and above, which a tilt of 0 raises by 45 degrees; the top one is drawn last',
         config([projected('SphericalMirrorProjection', tilt=20,
                           geometry={k: k + '.obj' for k in ('bottom', 'left', 'right', 'top')})]),
         [(0.5, 0.125), (0.25, 0.25), (0.75, 0.3), (0.5, 0.6), (0.5, 0.45), (0.1, 0.9)], mirror)
    case('missing_mesh', 'a mesh that is not there is named with its place',
         config([square(mesh='D:/meshes/nowhere.sgc')]),
         error='nodes[0].windows[0].viewports[0].mesh: expected the file "D:/meshes/nowhere.sgc"')
    case('missing_mesh_elsewhere', 'but does not hide the other displays',
         config([{**square(mesh='nowhere.sgc'), 'size': {'x': 0.5, 'y': 1}},
                 {**square(), 'pos': {'x': 0.5, 'y': 0}, 'size': {'x': 0.5, 'y': 1}}]), CORNERS,
         lambda s, t: planar(s, t, 45, 45, 45, 45), width=W // 2, display='viewport2')


def window_cases():
    case('most_viewports', 'a configuration may have 256 viewports', config([square()] * 257),
         error='at most 256 viewports in a configuration')
    case('framebuffer', 'res is the size of the picture, not size',
         config([square()], window={'res': {'x': 256, 'y': 64}}), CORNERS,
         lambda s, t: planar(s, t, 45, 45, 45, 45), width=256, height=64)
    case('viewport_share', 'a viewport has its share of the pixels of the window, to the nearest one',
         config([{**square(), 'pos': {'x': 0.66666, 'y': 0}, 'size': {'x': 0.33333, 'y': 0.5}}],
                window={'size': {'x': 192, 'y': 64}}), CORNERS, lambda s, t: planar(s, t, 45, 45, 45, 45))
    case('mirrored_window', 'mirrorx and mirrory turn the picture over',
         config([projected('PlanarProjection', fov=ANGLES)], window={'mirrorx': True, 'mirrory': True}), CORNERS,
         lambda s, t: planar(1 - s, 1 - t, 30, 40, 10, 20))
    stereo = config([square()], window={'stereo': 'side_by_side'}, users=[{'eyeseparation': 0.5}])
    case('stereo', "of side by side stereo one eye's half is taken, seen from the middle between the eyes", stereo,
         CORNERS, lambda s, t: planar(s, t, 45, 45, 45, 45), width=W // 2, assumptions={'stereo_eye': 'none'},
         warning='side_by_side is for two eyes')
    case('stereo_eye', 'or from one of them', stereo, CORNERS,
         lambda s, t: planar(s, t, 45, 45, 45, 45, eye=[0.25, 0, 0]), width=W // 2, assume={'stereo_eye': 'right'})
    case('window_without_scene', 'a window that does not draw the scene is left out',
         {**config([square()]), 'nodes': [{'address': 'a', 'port': 1, 'windows': [
             {'size': {'x': W, 'y': H}, 'viewports': [square()]},
             {'size': {'x': W, 'y': H}, 'viewports': [square()], 'draw3d': False}]}]},
         warning='nodes[0].windows[1].draw3d')
    case('unknown_keys', 'keys that are not known are passed over and named',
         config([projected('FisheyeProjection', fov='180', strength=3)]), [(0.5, 0.5)], lambda s, t: [0, 1, 0],
         warning='nodes[0].windows[0].viewports[0].projection.strength')
    write('mask.png', png(2, 1, [128, 255]))
    case('blend_mask', 'masks multiply encoded colours; one of another size is resampled',
         config([square(blendmask='mask.png')]), assumptions={'blend_gamma': '2.2'}, warning='it is resampled')
    case('black_level_mask', 'a black level mask multiplies too', config([square(blacklevelmask='mask.png')]),
         assumptions={'black_level': 'multiply'})
    case('overlay', 'an overlay is not drawn', config([square(overlay='logo.png')]), warning='logo.png is not drawn')
    case('moved_scene', 'the pose of the scene is none of the wall',
         {**config([square()]), 'scene': {'orientation': {'yaw': 0, 'pitch': -90, 'roll': 0}}}, CORNERS,
         lambda s, t: planar(s, t, 45, 45, 45, 45), warning='give the camera that pose')


def cluster(viewport, user=''):
    return ('<?xml version="1.0" ?>\n<Cluster masterAddress="localhost">\n <Node ip="localhost" port="20400">\n'
            '  <Window fullScreen="false">\n   <Stereo type="none" />\n   <Size x="%d" y="%d" />\n   %s\n'
            '  </Window>\n </Node>\n <User eyeSeparation="0.06">%s</User>\n</Cluster>\n' % (W, H, viewport, user))


def xml_cases():
    fov = '<FOV left="30" right="40" up="20" down="10" />'
    case('xml_planar', 'older XML says the same in elements; heading is yaw',
         cluster('<Viewport><PlanarProjection>%s<Orientation heading="30" pitch="20" roll="10" />'
                 '</PlanarProjection></Viewport>' % fov), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, turned(30, 20, 10)))
    case('xml_angles_about_axes', 'x, y and z of an orientation without w are angles about these axes, in this order',
         cluster('<Viewport><PlanarProjection>%s<Orientation x="10" y="20" z="30" /></PlanarProjection></Viewport>' %
                 fov), CORNERS,
         lambda s, t: planar(s, t, 30, 40, 10, 20, product(product(about('x', 10), about('y', 20)), about('z', 30))))
    case('xml_viewplane', 'a Viewplane has the corners lower left, upper left, upper right, in metres',
         cluster('<Viewport><Viewplane><Pos x="-1" y="-1" z="0.5" /><Pos x="-1.2" y="1" z="0.25" />'
                 '<Pos x="1.5" y="1.1" z="-1" /></Viewplane></Viewport>', '<Pos x="0.1" y="0.2" z="2" />'), CORNERS,
         lambda s, t: plane(s, t, [-1, -1, 0.5], [-1.2, 1, 0.25], [1.5, 1.1, -1], [0.1, 0.2, 2]))
    case('xml_fisheye', 'elements and attributes may be written in any letter case',
         cluster('<viewport><Pos x="0" y="0"/><Size x="1" y="1"/><FisheyeProjection FOV="180" Tilt="90" '
                 'quality="4k"><Background r="0.1" g="0.1" b="0.1" a="1"/></FisheyeProjection></viewport>'),
         [(0.5, 0.5), (0.6, 0.7)], lambda s, t: fisheye(0.5 + (s - 0.5) * W / H, t, tilt=90))
    case('xml_mask', 'a mask of older XML is a blend mask, and what a black level mask says is added',
         cluster('<Viewport mask="mask.png" BlackLevelMask="mask.png" />'),
         assumptions={'black_level': 'add', 'blend_gamma': '2.2'})
    case('xml_two_corners', 'a Viewplane of two corners is none',
         cluster('<Viewport><Viewplane><Pos x="-1" y="-1" z="0" /><Pos x="-1" y="1" z="0" /></Viewplane></Viewport>'),
         error='expected three corners')
    case('xml_document_type', 'XML with a document type is refused',
         '<!DOCTYPE Cluster SYSTEM "http://example.com/x.dtd">\n' + cluster('<Viewport />'), error='DOCTYPE')


if __name__ == '__main__':
    planar_cases()
    plane_cases()
    fisheye_cases()
    other_projection_cases()
    mesh_cases()
    window_cases()
    xml_cases()
