"""What fuzzing found stays mended."""

from __future__ import annotations

import pytest

from foon_asp.errors import InputError
from support.foon_texts import EXAMPLES
from support.reading_checks import check, read


@pytest.mark.parametrize(
    "data",
    [
        # Found by benchmarks/fuzz_reader.py: a last line of nothing but control characters was mended twice;
        b"O\ta\x00\nM\tx\nO\tb\n\x00",
        # a tab in the name of a video did not come back from JSON;
        b"# Source:\thttp:\tone\nO\ta\nM\tx\nO\tb\n//\n",
        # a byte order mark became the first of a file only by mending.
        b"\x00\xef\xbb\xbf# c\nO\ta\nM\tx\nO\tb\n//\n",
        b"\n\xef\xbb\xbfO\ta\nM\tx\nO\tb\n//\n",
    ],
)
def test_what_fuzzing_found_stays_mended(data: bytes) -> None:
    assert check(data) is not None


@pytest.mark.parametrize("start", ["\x00[", "\n" * 5000 + "[", "\u2003\n\ufeff{"])
def test_what_mending_would_make_json_is_json(start: str) -> None:
    # Found by benchmarks/fuzz_reader.py, too.
    with pytest.raises(InputError, match="not JSON"):
        read(start + "a\nO\ta\nM\tx\nO\tb\n//\n")


def test_the_fuzzers_seeds_and_all_examples_pass() -> None:
    for example in EXAMPLES.values():
        assert check(example if isinstance(example, bytes) else example.encode()) is not None
