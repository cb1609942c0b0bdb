"""How criteria are read and written."""

from __future__ import annotations

from fractions import Fraction

import pytest

from foon_asp.errors import QueryError
from foon_asp.query.objective import CRITERIA, Criterion, Objective
from foon_asp.query.tariff import Tariff, Totals


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("unit", r"no criterion 'unit'; closest: units"),
        ("units,2*units+inputs", r"named twice"),
        ("units+units", r"named twice"),
        ("0*units", r"above 0"),
        ("-1*units", r"write a, or 2\*a\+b"),
        ("10000000000*units+0.0001*inputs", r"too far apart"),
        ("units*2", r"write a, or 2\*a\+b"),
    ],
)
def test_sums_that_make_no_sense_are_refused(text: str, message: str) -> None:
    with pytest.raises(QueryError, match=message):
        Objective.parse(text)


@pytest.mark.parametrize("text", ["units", "2*units+inputs", "success+0.5*units", "depth,tools,human"])
def test_a_list_of_criteria_is_written_as_it_was_read(text: str) -> None:
    assert ",".join(map(str, Objective.parse(text))) == text


@pytest.mark.parametrize(
    ("text", "weights", "scale"),
    [
        ("0.25*units+2*inputs", {"units": 1, "inputs": 8}, 4),
        ("3*units+6*inputs", {"units": 1, "inputs": 2}, Fraction(1, 3)),
        # As fine as it is ever made: 10^8 for a unit of the logarithm.
        ("2*success+units", {"success": 1, "units": 50_000_000}, 50_000_000),
        # Ten million seconds, three times, and little for success: 2^31 holds 71 times as much.
        ("3*time+success", {"success": 1, "time": 213}, 71),
    ],
)
def test_weights_keep_their_ratios(text: str, weights: dict[str, int], scale: Fraction) -> None:
    totals = Totals(
        {"units": Fraction(4), "inputs": Fraction(9), "time": Fraction(10**7), "success": Fraction(2)}, False
    )
    tariff = Tariff.of(Criterion.parse(text), totals)
    assert (tariff.weights, tariff.scale) == (weights, scale)


def test_a_list_of_all_criteria_names_all() -> None:
    assert {name for level in Objective.parse(",".join(CRITERIA)) for name in level.names} == set(CRITERIA)
