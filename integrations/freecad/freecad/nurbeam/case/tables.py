"""Rows of a spreadsheet as a table over time."""

import re

import FreeCAD

from .values import rounded


class BadTable(ValueError):
    """A range that holds no table; the text names the cell."""


def rows_of_table(sheet, cells, units):
    """The rows of the cells "A1:D9" in these SI units, one for each column; the first row has the units of the columns, as
    "s" and "mm". BadTable where it is none."""
    first, last = _corners(cells)
    columns = range(first[0], last[0] + 1)
    if len(columns) != len(units):
        raise BadTable(f"{cells} has {len(columns)} columns; expected {len(units)}: {', '.join(units)}")
    heads = [_unit(sheet, column, first[1]) for column in columns]
    rows = []
    for row in range(first[1] + 1, last[1] + 1):
        pairs = zip(columns, heads, units)
        rows.append([_value(sheet, column, row, head, unit) for column, head, unit in pairs])
    if not rows:
        raise BadTable(f"{cells} has no row but that of the units; expected rows below it")
    return rows


def _corners(cells):
    found = re.fullmatch(r"\s*([A-Z]{1,2})(\d+)\s*:\s*([A-Z]{1,2})(\d+)\s*", cells.upper())
    if not found:
        raise BadTable(f'"{cells}" is no range of cells; expected one as A1:B9')
    first, last = (_column(found[1]), int(found[2])), (_column(found[3]), int(found[4]))
    if last[0] < first[0] or last[1] < first[1]:
        raise BadTable(f'"{cells}" ends before it begins; expected one as A1:B9')
    return first, last


def _column(letters):
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _name(column, row):
    letters = ""
    while column:
        column, rest = divmod(column - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return f"{letters}{row}"


def _content(sheet, column, row):
    cell = _name(column, row)
    try:
        return cell, sheet.get(cell)
    except ValueError:
        raise BadTable(f"the cell {cell} of {sheet.Label} is empty") from None


def _unit(sheet, column, row):
    cell, content = _content(sheet, column, row)
    if content == 1:
        return "1"
    if not isinstance(content, str):
        raise BadTable(f"the cell {cell} of {sheet.Label} has a number; the first row has units, as s or mm; 1 for none")
    return content.strip()


def _value(sheet, column, row, head, unit):
    """A number in the unit of its column, or a quantity, or the text of one."""
    cell, content = _content(sheet, column, row)
    try:
        if isinstance(content, (int, float)):
            content = f"{float(content)!r} {'' if head in ('1', '-') else head}"
        quantity = FreeCAD.Units.Quantity(content)
        value = quantity if unit == "1" else quantity.getValueAs(unit)
        return rounded(getattr(value, "Value", value))
    except (ValueError, ArithmeticError, TypeError):
        raise BadTable(f"the cell {cell} of {sheet.Label} is {content}; expected a quantity in {unit}") from None
