"""How objects look: in the tree, in the 3-D view, while results are looked at."""

import os

ICONS = os.path.join(os.path.dirname(os.path.dirname(__file__)), "resources", "icons")


def icon(name):
    return os.path.join(ICONS, f"{name}.svg")
