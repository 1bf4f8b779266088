"""What all objects of the workbench have in common: properties by a table, units, versions, and files that outlive them."""

from typing import Any, NamedTuple, Optional, Sequence

import FreeCAD

SCHEMA_VERSION = 2  # 2: the axis of a beam may be of several objects
OUTPUT = 8  # of addProperty: a value that is written does not ask for a recompute
READ_ONLY, HIDDEN_READ_ONLY = 1, 3  # of setEditorMode


class Property(NamedTuple):
    """A row of the table of an object."""

    type: str
    """Without "App::Property"."""
    name: str
    group: str
    help: str
    default: Any = None
    """A quantity as a text with its unit."""
    unit: str = ""
    """Of a Quantity, which is born without one."""
    choices: Sequence[str] = ()
    output: bool = False
    """Found by the workbench, and not to be written by hand."""
    hidden: bool = False


COMMON = (
    Property("String", "NurbeamType", "Base", "Kind of object, by which the workbench finds it", hidden=True, output=True),
    Property("Integer", "SchemaVersion", "Base", "Of the properties", hidden=True, output=True),
    Property("String", "ExtraKeys", "More", "JSON, merged over the keys that this object writes into the case"),
)


class NewerObject(Exception):
    """An object that a newer workbench has written."""


class Feature:
    """The proxy of an object. A subclass has `TYPE`, `PROPERTIES` and what it checks or computes."""

    TYPE = ""
    CONTAINER = "App::FeaturePython"
    PROPERTIES: Sequence[Property] = ()
    RENAMED: "dict[int, dict[str, str]]" = {}
    """By the SchemaVersion before which they bore them: old names of properties, each with its present name."""

    complaint = ""
    """What the last check or run found wrong with the object; a recompute says it again."""

    def __init__(self, obj: Any):
        obj.Proxy = self
        self.complete(obj)

    @classmethod
    def table(cls) -> Sequence[Property]:
        return (*COMMON, *cls.PROPERTIES)

    def complete(self, obj: Any) -> None:
        """Adds the properties that the object lacks, and gives quantities their unit, which files do not keep."""
        for row in self.table():
            if row.name not in obj.PropertiesList:
                _add(obj, row)
            elif row.unit and _has_no_unit(getattr(obj, row.name)):
                setattr(obj, row.name, FreeCAD.Units.Unit(row.unit))
            mode = HIDDEN_READ_ONLY if row.hidden else READ_ONLY if row.output else None
            if mode is not None:
                obj.setEditorMode(row.name, mode)
        obj.NurbeamType = self.TYPE
        if obj.SchemaVersion < SCHEMA_VERSION:
            obj.SchemaVersion = SCHEMA_VERSION

    def onDocumentRestored(self, obj: Any) -> None:
        if is_newer(obj):
            obj.touch()
            return
        self.migrate(obj)
        self.complete(obj)

    def migrate(self, obj: Any) -> None:
        """Carries values of properties that had another name or type in older documents over to the present one."""
        version = obj.SchemaVersion if "SchemaVersion" in obj.PropertiesList else 0
        for before, names in sorted(self.RENAMED.items()):
            if version >= before:
                continue
            for old, new in names.items():
                if old in obj.PropertiesList:
                    _rename(obj, old, next(row for row in self.table() if row.name == new))
        for row in self.table():
            if row.name in obj.PropertiesList and obj.getTypeIdOfProperty(row.name) != f"App::Property{row.type}":
                _change_type(obj, row)

    def onChanged(self, obj: Any, prop: str) -> None:
        """A complaint is about values as they were."""
        if self.complaint and any(row.name == prop and not row.output for row in self.table()):
            self.complaint = ""

    def execute(self, obj: Any) -> None:
        if is_newer(obj):
            raise NewerObject(f"a newer nurbeam workbench wrote this object (version {obj.SchemaVersion}, known up to "
                              f"{SCHEMA_VERSION}); install that one")  # fmt: skip
        self.compute(obj)
        if self.complaint:
            raise ValueError(self.complaint)

    def compute(self, obj: Any) -> None:
        """What a recompute does; nothing where an object only holds values."""

    def dumps(self) -> None:
        return None

    def loads(self, state: Any) -> None:
        return None

    __getstate__ = dumps
    __setstate__ = loads


def _add(obj: Any, row: Property) -> None:
    obj.addProperty(f"App::Property{row.type}", row.name, row.group, row.help, OUTPUT if row.output else 0)
    if row.choices:
        setattr(obj, row.name, list(row.choices))
    if row.unit:
        setattr(obj, row.name, FreeCAD.Units.Unit(row.unit))
    if row.default is not None:
        setattr(obj, row.name, row.default)


def _has_no_unit(value: Any) -> bool:
    return value.Unit == FreeCAD.Units.Unit()


def _rename(obj: Any, old: str, row: Property) -> None:
    value, expression = getattr(obj, old), dict(obj.ExpressionEngine).get(old)
    obj.setExpression(old, None)
    if row.name not in obj.PropertiesList:
        _add(obj, row)
    setattr(obj, row.name, value)
    if expression:
        obj.setExpression(row.name, expression)
    obj.removeProperty(old)


def _change_type(obj: Any, row: Property) -> None:
    value = getattr(obj, row.name)
    obj.removeProperty(row.name)
    _add(obj, row)
    setattr(obj, row.name, value)


def is_newer(obj: Any) -> bool:
    return "SchemaVersion" in obj.PropertiesList and obj.SchemaVersion > SCHEMA_VERSION


def type_of(obj: Any) -> Optional[str]:
    """The NurbeamType of an object; None of another one's."""
    return obj.NurbeamType if "NurbeamType" in getattr(obj, "PropertiesList", ()) else None
