"""Supports, bodies, loads and what else stands on beams, as the parts of a case."""

from ..geometry import places
from .tables import rows_of_table
from .values import metres, si, times_unit, vector


def place_of(obj, writer, path, prefix=""):
    """The place of a beam that an object stands at."""
    kind = getattr(obj, f"{prefix}PlaceKind")
    writer.place(path, obj, f"{prefix}PlaceKind")
    if kind in ("Start", "End"):
        return kind.lower()
    if kind == "Length":
        writer.place(path, obj, f"{prefix}PlaceLength")
        return {"length": si(getattr(obj, f"{prefix}PlaceLength"), "m")}
    if kind == "Fraction":
        writer.place(path, obj, f"{prefix}Fraction")
        return {"fraction": getattr(obj, f"{prefix}Fraction")}
    writer.place(path, obj, f"{prefix}Point")
    with writer.faults_of(obj, f"{prefix}Point"):
        return {"near": metres(places.point_of_link(getattr(obj, f"{prefix}Point")))}
    return None


def on_beam(obj, writer, path):
    """The beam of an object, and its place on it."""
    writer.place(f"{path}.beam", obj, "Beam")
    return {"beam": writer.beam_name(obj, "Beam"), "at": place_of(obj, writer, f"{path}.at")}


def _slope(obj, keys, writer, path, prefix=""):
    writer.place(f"{path}.slope", obj, f"{prefix}Slope")
    if getattr(obj, f"{prefix}Slope") != "Automatic":
        keys["slope"] = getattr(obj, f"{prefix}Slope").lower()


def _table(obj, writer, path):
    """The rows of the table of an object; None where it has none."""
    writer.place(path, obj, "Range")
    if obj.Table is None:
        return None
    with writer.faults_of(obj, "Range"):
        return rows_of_table(obj.Table, obj.Range, obj.Proxy.TABLE_UNITS)
    return None


def support_keys(obj, name, writer, path):
    keys = {"name": name, **on_beam(obj, writer, path), "type": obj.SupportKind.lower()}
    writer.place(path, obj, "SupportKind")
    if obj.SupportKind == "Guided":
        keys["direction"] = vector(obj.Direction)
        if pull := si(obj.Pull, "N"):
            keys["force"] = pull
        if mass := si(obj.PullMass, "kg"):
            keys["mass"] = mass
    if obj.SupportKind == "Pinned" and obj.HingeAxis.Length > 0:
        keys["axis"] = vector(obj.HingeAxis)
    if rows := _table(obj, writer, f"{path}.motion"):
        keys["motion"] = rows
    for key, prop in (("direction", "Direction"), ("force", "Pull"), ("mass", "PullMass"), ("axis", "HingeAxis")):
        writer.place(f"{path}.{key}", obj, prop)
    _slope(obj, keys, writer, path)
    return keys


# Extra keys of a sliding body that are those of the body; all others are of its joint.
BODY_KEYS = ("mass", "roll_inertia", "drag_area", "position", "inertia", "axes", "points", "turned", "angular_velocity", "rotor",
             "fastened", "velocity")  # fmt: skip


def body_keys(obj, name, writer, path):
    keys = {"name": name, "mass": si(obj.Mass, "kg")}
    for key, prop, unit in (("roll_inertia", "RollInertia", "kg*m^2"), ("drag_area", "DragArea", "m^2")):
        if value := si(getattr(obj, prop), unit):
            keys[key] = value
        writer.place(f"{path}.{key}", obj, prop)
    writer.place(path, obj, "Mass")
    return keys


def sliding_joint_keys(obj, name, writer, path):
    writer.place(path, obj, "Beam")
    keys = {"body": name, **on_beam(obj, writer, path)}
    if speed := si(obj.Speed, "m/s"):
        keys["speed"] = speed
    if release := si(obj.Release, "s"):
        keys["release"] = release
    if rows := _table(obj, writer, f"{path}.motion"):
        keys["motion"] = {"table": rows}
    friction = {}
    if obj.Friction:
        friction["coefficient"] = obj.Friction
    if obj.StaticFriction:
        friction["static"] = obj.StaticFriction
    if brake := si(obj.Brake, "N"):
        friction["force"] = brake
    if friction:
        keys["friction"] = friction
    names = (("speed", "Speed"), ("release", "Release"), ("friction", "Friction"), ("friction.static", "StaticFriction"),
             ("friction.force", "Brake"), ("at_beam_end", "AtEnd"))  # fmt: skip
    for key, prop in names:
        writer.place(f"{path}.{key}", obj, prop)
    _slope(obj, keys, writer, path)
    keys["at_beam_end"] = obj.AtEnd.lower()
    return keys


LOADS = {"Force": ("force", "Force", "N"), "Moment": ("moment", "Moment", "N*m"),
         "Force per length": ("force_per_length", "ForcePerLength", "N/m"),
         "Torque per length": ("torque_per_length", "TorquePerLength", "N")}  # fmt: skip


def load_keys(obj, writer, path):
    key, prop, unit = LOADS[obj.LoadKind]
    size = si(getattr(obj, prop), unit)
    writer.place(path, obj, prop)
    writer.place(f"{path}.beam", obj, "Beam")
    keys = {"beam": writer.beam_name(obj, "Beam")}
    if obj.LoadKind in ("Force", "Moment"):
        keys["at"] = place_of(obj, writer, f"{path}.at")
        if obj.Follower:
            keys["follower"] = True
    keys[key] = size if key == "torque_per_length" else _directed(obj, size, writer)
    if rows := _table(obj, writer, f"{path}.time"):
        keys["time"] = rows
    if obj.LoadKind == "Force":
        _slope(obj, keys, writer, path)
    return keys


def _directed(obj, size, writer):
    with writer.faults_of(obj, "DirectionOf" if obj.DirectionOf else "Direction"):
        direction = places.direction_of_link(obj.DirectionOf) if obj.DirectionOf else obj.Direction
        force = times_unit(size, direction)
        if force is None:
            raise ValueError("is 0 0 0, which is no direction; give one of any length")
        return force
    return None


def joint_keys(obj, name, writer, path):
    writer.place(path, obj, "Beams")
    keys = {"name": name, "beams": writer.beam_names(obj, "Beams", 2), "type": obj.JointKind.lower()}
    if obj.Point:
        with writer.faults_of(obj, "Point"):
            keys["at"] = {"near": metres(places.point_of_link(obj.Point))}
    if obj.HingeAxis.Length > 0:
        keys["axis"] = vector(obj.HingeAxis)
    for key, prop in (("type", "JointKind"), ("at", "Point"), ("axis", "HingeAxis")):
        writer.place(f"{path}.{key}", obj, prop)
    _slope(obj, keys, writer, path)
    return keys


def _connector_end(obj, prefix, writer, path):
    target = getattr(obj, f"{prefix}Object")
    writer.place(path, obj, f"{prefix}Object")
    if target is None:
        with writer.faults_of(obj, f"{prefix}Point"):
            return {"point": metres(places.point_of_link(getattr(obj, f"{prefix}Point")))}
        return None
    if target in writer.bodies:
        return {"body": writer.bodies[target]}
    end = {"beam": writer.beam_name(obj, f"{prefix}Object"), "at": place_of(obj, writer, f"{path}.at", prefix)}
    _slope(obj, end, writer, path, prefix)
    return end


def _write_stretched(obj, keys):
    if obj.ConnectorKind != "Rod":
        keys["stiffness"] = si(obj.Stiffness, "N/m")
        if damping := si(obj.Damping, "N*s/m"):
            keys["damping"] = damping
    if obj.LengthKind == "Length":
        keys["length"] = si(obj.FreeLength, "m")
    elif obj.LengthKind == "Force":
        keys["force"] = si(obj.Force, "N")
    if obj.Direction.Length > 0:
        keys["direction"] = vector(obj.Direction)
    masses = [si(obj.FromMass, "kg"), si(obj.ToMass, "kg")]
    if any(masses):
        keys["end_masses"] = masses
    return (("stiffness", "Stiffness"), ("damping", "Damping"), ("length", "FreeLength"), ("force", "Force"), ("direction", "Direction"),
            ("end_masses", "FromMass"))  # fmt: skip


def _write_rotational(obj, keys):
    keys["stiffness"] = si(obj.RotationalStiffness, "N*m/rad")
    if obj.RotationAxis.Length > 0:
        keys["axis"] = vector(obj.RotationAxis)
    for key, prop, unit in (("damping", "RotationalDamping", "N*m*s/rad"), ("angle", "FreeAngle", "deg"), ("moment", "Moment", "N*m")):
        if value := si(getattr(obj, prop), unit):
            keys[key] = value
    return (("stiffness", "RotationalStiffness"), ("damping", "RotationalDamping"), ("axis", "RotationAxis"), ("angle", "FreeAngle"),
            ("moment", "Moment"))  # fmt: skip


def connector_keys(obj, name, writer, path):
    writer.place(path, obj, "ConnectorKind")
    keys = {"name": name, "from": _connector_end(obj, "From", writer, f"{path}.from"),
            "to": _connector_end(obj, "To", writer, f"{path}.to"), "type": obj.ConnectorKind.lower().replace(" ", "-")}  # fmt: skip
    if obj.ConnectorKind == "Rotational":
        names = _write_rotational(obj, keys)
    else:
        names = _write_stretched(obj, keys)
    for key, prop in names:
        writer.place(f"{path}.{key}", obj, prop)
    return keys


def stop_keys(obj, writer, path):
    writer.place(path, obj, "StopKind")
    writer.place(f"{path}.beam", obj, "Beam")
    keys = {"beam": writer.beam_name(obj, "Beam")}
    if obj.BetweenBodies:
        keys["gap"] = si(obj.Gap, "m")
    else:
        keys["at"] = place_of(obj, writer, f"{path}.at")
        if obj.Side != "Both":
            keys["side"] = obj.Side.lower()
    if obj.Bodies:
        keys["bodies"] = writer.body_names(obj, "Bodies")
    if obj.StopKind == "Buffer":
        keys["stiffness"] = si(obj.Stiffness, "N/m")
        if damping := si(obj.Damping, "N*s/m"):
            keys["damping"] = damping
    else:
        keys["restitution"] = obj.Restitution
    names = (("gap", "Gap"), ("side", "Side"), ("bodies", "Bodies"), ("stiffness", "Stiffness"), ("damping", "Damping"), ("restitution", "Restitution"))
    for key, prop in names:
        writer.place(f"{path}.{key}", obj, prop)
    return keys


def probe_keys(obj, name, writer, path):
    writer.place(path, obj, "Side")
    keys = {"name": name, **on_beam(obj, writer, path)}
    if obj.Side == "Before":
        keys["side"] = "before"
    return keys
