"""configs/wall.schema.json against the walls that ship and against the program's own reader."""

import copy
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

try:
    import jsonschema
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: install Debian's python3-jsonschema")

CONFIGS = pathlib.Path(os.environ["CURVEWALL_CONFIGS"])
VERDICTS = os.environ["CURVEWALL_WALL_VERDICTS"]  # the program of wall_verdicts.cpp

SCHEMA = json.loads((CONFIGS / "wall.schema.json").read_text())
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)

SHIPPED = {
    path.name: json.loads(path.read_text())
    for path in sorted(CONFIGS.glob("*.json"))
    if path.name not in ("daemon.json", "wall.schema.json")
}

# What depends on several values at once, or on files, is beyond the schema.
BEYOND_THE_SCHEMA = (
    "a screen that the eye can see",
    "a polynomial that increases up to half of fov_deg",
    "left_deg below right_deg and down_deg below up_deg",
    "a name of its own",
)

# Keys that no shipped wall has.
RARE_PROJECTIONS = [
    {"type": "camera", "model": "pinhole", "focal_px": [500, 500], "principal_px": [160, 120],
     "distortion": [0.01] * 14, "center": [0, 0, 0], "yaw_deg": 1, "pitch_deg": 2, "roll_deg": 3},
    {"type": "radial", "model": "polynomial", "fov_deg": 170, "coefficients": [1, 0, 0.01],
     "center": [0.1, 0.1, 0.1], "surface": {"type": "sphere", "center": [0, 0, 0], "radius": 3}},
    {"type": "frustum", "left_deg": -30, "right_deg": 40, "down_deg": -20, "up_deg": 25, "center": [0, 0, 0],
     "yaw_deg": 1, "pitch_deg": 2, "roll_deg": 3},
    {"type": "radial", "model": "stereographic", "fov_deg": 170, "yaw_deg": 1, "pitch_deg": 2, "roll_deg": 3},
]
BLEND = {"alpha": "map.pfm", "beta": "map.pfm", "gamma": [2.2, 2.2, 2.2]}


def write_map(path, size):
    width, height = size
    path.write_bytes(f"Pf\n{width} {height}\n-1.0\n".encode() + struct.pack("<f", 0.5) * (width * height))


def wall_of(display):
    return {"wall": "w", "eye": [0, 0, 0], "background": [0, 0, 0], "displays": [display]}


def sample_walls():
    """One display for each type and model, each in a wall of its own; the first has all that a wall can have."""
    first = {"name": "d", "size": [8, 6], "blend": BLEND,
             "projection": {"type": "cylinder", "radius": 2, "arc_deg": 90, "height": 3, "center": [0, 0, 0],
                            "yaw_deg": 1, "pitch_deg": 2, "roll_deg": 3}}
    walls = [wall_of(first)]
    seen = set()
    for wall in SHIPPED.values():
        for display in wall["displays"]:
            kind = tuple(display["projection"].get(key) for key in ("type", "model", "surface"))
            kind = (kind[0], kind[1], kind[2] is not None)
            if kind not in seen:
                seen.add(kind)
                # Small, since the reader computes something for every pixel of some.
                walls.append({**wall, "displays": [{**display, "size": [64, 48]}]})
    for projection in RARE_PROJECTIONS:
        walls.append(wall_of({"name": "d", "size": [320, 240], "projection": projection}))
    return walls


def limits(schema):
    """Every end of a range that the schema knows."""
    if isinstance(schema, list):
        return set().union(*map(limits, schema))
    if not isinstance(schema, dict):
        return set()
    ends = {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"}
    own = {schema[key] for key in ends & schema.keys()}
    return own.union(*map(limits, schema.values()))


def words(schema):
    """Everything that the schema lets one choose among."""
    if isinstance(schema, list):
        return set().union(*map(words, schema))
    if not isinstance(schema, dict):
        return set()
    return set(schema.get("enum", ())).union(*map(words, schema.values()))


def foreign_keys(projection):
    """Keys that other projections have, with a value of theirs."""
    keys = {}
    for wall in sample_walls():
        keys |= wall["displays"][0]["projection"]
    return {key: value for key, value in keys.items() if key not in projection}


def numbers_around_limits():
    numbers = set()
    for limit in limits(SCHEMA):
        step = 1 if abs(limit) >= 100 else 0.01
        numbers |= {limit - step, limit, limit + step}
    return sorted(numbers)


NUMBERS = numbers_around_limits()


def places(value, path=()):
    """Paths to all values, the first and the last of a list of numbers only."""
    yield path
    if isinstance(value, dict):
        for key in value:
            yield from places(value[key], path + (key,))
    elif isinstance(value, list):
        for index in sorted({0, len(value) - 1}):
            if value:
                yield from places(value[index], path + (index,))


def at(wall, path):
    for step in path:
        wall = wall[step]
    return wall


def changed(wall, path, value):
    if not path:
        return value
    wall = copy.deepcopy(wall)
    at(wall, path[:-1])[path[-1]] = value
    return wall


def without(wall, path):
    wall = copy.deepcopy(wall)
    del at(wall, path[:-1])[path[-1]]
    return wall


class Mutant:
    def __init__(self, what, wall, must_be_refused=False):
        self.what = what
        self.wall = wall
        self.must_be_refused = must_be_refused


def mutants_at(wall, path):
    """Changes of one value; the schema and the reader have to agree on each."""
    value = at(wall, path)
    name = "/" + "/".join(map(str, path))
    if isinstance(value, dict):
        yield Mutant(f"{name} with an unknown key", changed(wall, path, {**value, "colour": 1}), True)
        for key in value:
            yield Mutant(f"{name} without {key}", without(wall, path + (key,)))
    if isinstance(value, list):
        for count in range(16):
            yield Mutant(f"{name} with {count} entries", changed(wall, path, (value * 16)[:count]))
    if type(value) in (int, float):
        for number in (-1e9, 1e9):
            yield Mutant(f"{name} far out of range", changed(wall, path, number), True)
        for number in NUMBERS:
            yield Mutant(f"{name} = {number}", changed(wall, path, number))
    if path[-1:] in (("type",), ("model",)):
        for word in sorted(words(SCHEMA)):
            yield Mutant(f"{name} = {word}", changed(wall, path, word))
    if path[-1:] == ("projection",):
        for key, foreign in foreign_keys(value).items():
            yield Mutant(f"{name} with {key}", changed(wall, path, {**value, key: foreign}))
    yield Mutant(f"{name} = null", changed(wall, path, None), True)
    for other in (True, "other", "a/b", "", 7, [], [0.5], {}):
        yield Mutant(f"{name} = {json.dumps(other)}", changed(wall, path, other))


def all_mutants():
    for index, wall in enumerate(sample_walls()):
        yield Mutant(f"sample {index} as it is", wall)
        inside = ("displays", 0, "projection")
        for path in places(wall):
            # What all walls have in common is looked at once.
            if index == 0 or path[:3] == inside:
                kind = wall["displays"][0]["projection"]["type"]
                for mutant in mutants_at(wall, path):
                    mutant.what = f"sample {index}, {kind}: {mutant.what}"
                    yield mutant


def readers_verdicts(walls):
    """What the reader says of each wall, with the files of configs/ beside them."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for entry in CONFIGS.iterdir():
            if entry.is_dir():
                (folder / entry.name).symlink_to(entry, target_is_directory=True)
        write_map(folder / "map.pfm", (8, 6))
        for index, wall in enumerate(walls):
            (folder / f"{index:08}.json").write_text(json.dumps(wall))
        output = subprocess.run([VERDICTS, str(folder)], check=True, capture_output=True, text=True).stdout
        verdicts = []
        for line in output.splitlines():
            name, message = line.split("\t", 1)
            of_this_file = message.startswith(str(folder / name))
            is_form = of_this_file and not any(phrase in message for phrase in BEYOND_THE_SCHEMA)
            verdicts.append(message.removeprefix(str(folder / name) + ": ") if is_form else "")
        return verdicts


def schemas_verdict(wall):
    error = jsonschema.exceptions.best_match(VALIDATOR.iter_errors(wall))
    return "" if error is None else f"{error.json_path}: {error.message}"


class ShippedWalls(unittest.TestCase):
    def test_the_schema_is_one(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)

    def test_every_wall_validates(self):
        self.assertGreaterEqual(len(SHIPPED), 17)
        for name, wall in SHIPPED.items():
            with self.subTest(wall=name):
                self.assertEqual(schemas_verdict(wall), "")


class SchemaAndReader(unittest.TestCase):
    maxDiff = None

    def test_samples_are_walls_for_both(self):
        walls = sample_walls()
        for wall, message in zip(walls, readers_verdicts(walls), strict=True):
            kind = wall["displays"][0]["projection"]
            with self.subTest(projection=kind):
                self.assertEqual(message, "")
                self.assertEqual(schemas_verdict(wall), "")

    def test_agree_on_every_change_of_a_wall(self):
        mutants = list(all_mutants())
        verdicts = readers_verdicts([mutant.wall for mutant in mutants])
        disagreements = []
        refused = 0
        for mutant, reader in zip(mutants, verdicts, strict=True):
            refused += bool(reader)
            accepted = VALIDATOR.is_valid(mutant.wall)
            if "the name of a file that is there" in reader and not mutant.must_be_refused:
                continue  # which files there are is not the schema's business
            if accepted == bool(reader) or (mutant.must_be_refused and accepted):
                schema = schemas_verdict(mutant.wall)
                disagreements.append(f"{mutant.what}\n  reader: {reader or 'ok'}\n  schema: {schema or 'ok'}")
        self.assertEqual(disagreements[:20], [], f"{len(disagreements)} of {len(mutants)} changes")
        self.assertGreater(refused, len(mutants) // 4)

    def test_know_the_same_types(self):
        in_schema = set(SCHEMA["definitions"]["projection"]["properties"]["type"]["enum"])
        [complaint] = readers_verdicts([wall_of({"name": "d", "size": [8, 6], "projection": {"type": "?"}})])
        in_reader = set(complaint.split("expected one of ")[1].split(", found")[0].split(", "))
        self.assertEqual(in_schema, in_reader)
        self.assertEqual({wall["displays"][0]["projection"]["type"] for wall in sample_walls()}, in_reader)


if __name__ == "__main__":
    unittest.main()
