"""Places of a case as objects and their properties."""

import re
from typing import Any, NamedTuple, Optional


# The path of a part or a key in a case.
PLACE = r"(?:beams|bodies|supports|sliding_joints|loads|joints|connectors|stops|analysis|output|gravity|air)\b[^\s:]*"


class Place(NamedTuple):
    obj: Any
    prop: str


def place_in_case(where):
    """The path in a case that a message is about: "case.json: beams[0].section" is about beams[0].section; "" for none."""
    found = re.search(rf"(?:^|: )({PLACE})$", where)
    return found[1] if found else ""


def object_at(places, where) -> Optional[Place]:
    """The place with the longest path that the place of a message begins with; None where it is about no object."""
    path = place_in_case(where)
    while path:
        if path in places:
            return places[path]
        path = re.sub(r"(\.[^.\[]*|\[[^\]]*\])$", "", path) if re.search(r"[.\[]", path) else ""
    return None
