"""Values of properties as a case has them: SI units, vectors, names."""

import json
import math
from typing import Any, NamedTuple

import FreeCAD

DIGITS = 10  # of quantities: FreeCAD keeps densities and the like to about 11


class Fault(NamedTuple):
    """What is wrong with an object, found before nurbeam is asked."""

    obj: Any
    prop: str
    message: str


def si(quantity, unit):
    """A quantity in an SI unit, to as many digits as a document keeps of it: 5200, and not 5200.0000000000001."""
    value = quantity.getValueAs(unit)
    return rounded(getattr(value, "Value", value))


def rounded(value):
    return float(f"{float(value):.{DIGITS}g}")


def vector(value):
    return [value.x, value.y, value.z]


def metres(point):
    """A point [mm] in metres."""
    return [point.x / 1000, point.y / 1000, point.z / 1000]


def times_unit(size, direction):
    """A vector of that size along a direction of any length; None where it has none."""
    if direction.Length == 0:
        return None
    unit = FreeCAD.Vector(direction).normalize()
    return [size * unit.x, size * unit.y, size * unit.z]


def name_for_case(label, taken, name):
    """The label as the name of a part of a case: without characters that nurbeam forbids, and unlike those taken."""
    plain = "".join("_" if c in ',"' or not c.isprintable() else c for c in label)[:240] or name
    if plain[0] in "=+-@":
        plain = "_" + plain[1:]
    return f"{plain} ({name})" if plain in taken else plain


def merged(case, text, is_meant=lambda key: True):
    """The keys of an object with those of a JSON text merged over them that are meant. ValueError where it is none."""
    if not text.strip():
        return case
    extra = json.loads(text)
    if not isinstance(extra, dict):
        raise ValueError('expected keys with their values, as in {"elements": {"count": 40}}')
    return _merge(case, {key: value for key, value in extra.items() if is_meant(key)})


def _merge(case, extra):
    result = dict(case)
    for key, value in extra.items():
        if value is None:
            result.pop(key, None)
        elif isinstance(value, dict) and isinstance(result.get(key), dict):
            result[key] = _merge(result[key], value)
        else:
            result[key] = value
    return result


def agree(a, b, of_points=False):
    """Whether two parts of cases are the same but for the last digits, which saving a document rounds."""
    if isinstance(a, dict) and isinstance(b, dict):
        points = of_points or bool({"control_points", "near", "point"} & set(a))
        return a.keys() == b.keys() and all(agree(a[k], b[k], points and k != "knots") for k in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(agree(x, y, of_points) for x, y in zip(a, b))
    if not (_is_number(a) and _is_number(b)):
        return a == b
    return math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-12 if of_points else 0)


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)
