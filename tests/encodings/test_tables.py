"""Every encoding has the models that its tables say."""

from __future__ import annotations

import pytest

from support.encoding_files import NAMES
from support.model_tables import CASES
from support.models import Case, models


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.encoding}: {case.says}")
def test_the_models_are_those_of_the_table(case: Case) -> None:
    expected = [" ".join(sorted(line.split(" "))) for line in case.models]
    assert [" ".join(sorted(line.split(" "))) for line in models(case)] == sorted(expected)


def test_every_encoding_has_a_table() -> None:
    assert {case.encoding for case in CASES} == set(NAMES)


def test_no_case_is_there_twice() -> None:
    said = [(case.encoding, case.says) for case in CASES]
    assert len(said) == len(set(said))
