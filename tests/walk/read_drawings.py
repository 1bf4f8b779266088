# read_drawings.py FILE...: the sum of the lengths of the curves of each drawing as ezdxf reads it, in metres, or what
# is wrong. Exit code 77 where ezdxf is not installed.
import json
import sys

try:
    import ezdxf
    from ezdxf import units
except ImportError:
    sys.exit(77)


def chords_of(spline, start, end, count):
    points = list(spline.points([start + (end - start) * i / count for i in range(count + 1)]))
    return sum(a.distance(b) for a, b in zip(points, points[1:]))


def length_of(entity):
    if entity.dxftype() == "LINE":
        return entity.dxf.start.distance(entity.dxf.end)
    spline = entity.construction_tool()
    knots = spline.knots()[spline.degree:len(spline.knots()) - spline.degree]
    chords, halved = (sum(chords_of(spline, a, b, count) for a, b in zip(knots, knots[1:]) if b > a) for count in (32, 64))
    return halved + (halved - chords) / 3  # whose errors go with the square of the chords


def total(file):
    try:
        document = ezdxf.readfile(file)
        errors = document.audit().errors
        if errors:
            return str(errors[0])
        return units.conversion_factor(document.units, units.M) * sum(length_of(e) for e in document.modelspace())
    except Exception as problem:
        return f"{type(problem).__name__}: {problem}"


print(json.dumps({file: total(file) for file in sys.argv[1:]}))
