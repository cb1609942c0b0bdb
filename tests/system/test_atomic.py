"""Files and folders are there whole, or as they were: killed, interrupted, out of space, all at once."""

from __future__ import annotations

import multiprocessing
import os
import resource
import signal
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from foon_asp.errors import InputError
from foon_asp.io import atomic
from support.writers import text_of, write_folder, write_on

BIG = 4_000_000


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def mode_of(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


@contextmanager
def mask(value: int) -> Iterator[None]:
    before = os.umask(value)
    try:
        yield
    finally:
        os.umask(before)


# Files


def test_a_file_is_written_and_replaced(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder" / "file"
    atomic.write_text(path, "süß\r\n")
    assert path.read_bytes() == "süß\r\n".encode()
    atomic.write_bytes(path, b"\0")
    assert path.read_bytes() == b"\0"
    with atomic.writing(path) as file:
        file.write(b"one ")
        file.write(b"two")
        assert path.read_bytes() == b"\0"
    assert path.read_bytes() == b"one two"
    assert names_in(path.parent) == ["file"]


def test_modes_are_kept_and_new_files_get_the_usual_one(tmp_path: Path) -> None:
    path = tmp_path / "file"
    with mask(0o027):
        atomic.write_text(path, "")
        assert mode_of(path) == 0o640
        for mode in (0o600, 0o666, 0o444, 0o755):
            path.chmod(mode)
            with atomic.writing(path) as file:
                # What only the owner may read, nobody may read in the making, either.
                (unfinished,) = tmp_path.glob(".*")
                assert mode_of(unfinished) == mode
                file.write(b"text")
            assert mode_of(path) == mode
            assert path.read_text() == "text"


def test_links_are_followed(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    link = tmp_path / "link"
    link.symlink_to(Path("there", "file"))
    for text in ("made", "replaced"):
        atomic.write_text(link, text)
        assert link.is_symlink()
        assert (tmp_path / "there" / "file").read_text() == text
    assert names_in(tmp_path / "there") == ["file"]
    (tmp_path / "round").symlink_to("round")
    with pytest.raises(InputError, match="cannot be written"):
        atomic.write_text(tmp_path / "round", "text")
    assert (tmp_path / "round").is_symlink()


def test_a_long_name_is_as_good_as_a_short_one(tmp_path: Path) -> None:
    path = tmp_path / ("ü" * 127)
    atomic.write_text(path, "text")
    with atomic.writing_folder(tmp_path / ("ö" * 127)) as folder:
        (folder / "file").write_text("text")
    assert path.read_text() == "text"
    with pytest.raises(InputError, match="File name too long"):
        atomic.write_text(tmp_path / ("ü" * 128), "text")


def test_a_pipe_is_written_to_as_it_is(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()))
    reader.start()
    atomic.write_text(pipe, "text")
    reader.join(10)
    assert read == ["text"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert names_in(tmp_path) == ["pipe"]
    atomic.write_text(Path("/dev/null"), "text")
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


WRITE = "from pathlib import Path; from foon_asp.io import atomic; "


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
def test_standard_output_goes_on_where_it_is(name: str, tmp_path: Path) -> None:
    code = f"{WRITE} print('one', flush=True); atomic.write_text(Path('{name}'), 'two\\n'); print('three')"
    piped = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert piped.stdout == "one\ntwo\nthree\n"
    path = tmp_path / "out"
    with path.open("w") as file:
        subprocess.run([sys.executable, "-c", code], stdout=file, check=True)
    assert path.read_text() == "one\ntwo\nthree\n"
    assert names_in(tmp_path) == ["out"]


def test_what_cannot_be_written_is_one_clear_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    for path, problem in (
        (tmp_path, r"cannot be written \(Is a directory\)"),
        (tmp_path / "file" / "x", r"cannot be written \(Not a directory\)"),
        (Path("/proc/x"), "cannot be written"),
        (Path("/dev/fd/987"), r"cannot be written \(Bad file descriptor\)"),
        (Path("a\0b"), r"^'a\\x00b': this is no file name; check the path$"),
    ):
        with pytest.raises(InputError, match=problem):
            atomic.write_text(path, "text")
    with pytest.raises(InputError, match=r"cannot be written \(UTF-8 has no character U\+DCFF\)"):
        atomic.write_text(tmp_path / "file", "a\udcff")
    assert names_in(tmp_path) == ["file"]
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_a_block_that_raises_changes_nothing(error: type[BaseException], tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "file").write_text("mine")

    def write_half_of_a_file() -> None:
        with atomic.writing(tmp_path / "file") as file:
            file.write(b"half")
            raise error

    def write_half_of_a_folder() -> None:
        with atomic.writing_folder(tmp_path / "folder") as folder:
            (folder / "file").write_text("half")
            raise error

    for write in (write_half_of_a_file, write_half_of_a_folder):
        with pytest.raises(error):
            write()
    assert names_in(tmp_path) == ["file", "folder"]
    assert (tmp_path / "file").read_text() == (tmp_path / "folder" / "file").read_text() == "mine"


def test_a_full_disk_changes_nothing(tmp_path: Path) -> None:
    """A limit on the size of files plays the disk: the system refuses to write on in the middle."""
    for name in ("file", "folder/file"):
        atomic.write_text(tmp_path / name, "mine")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (BIG // 2, before[1]))
    try:
        with pytest.raises(InputError, match=r"file: cannot be written \(File too large\)"):
            atomic.write_bytes(tmp_path / "file", bytes(BIG))
        with (
            pytest.raises(InputError, match=r"folder: cannot be written \(File too large\)"),
            atomic.writing_folder(tmp_path / "folder") as folder,
        ):
            (folder / "file").write_bytes(bytes(BIG))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert names_in(tmp_path) == ["file", "folder"]
    assert (tmp_path / "file").read_text() == (tmp_path / "folder" / "file").read_text() == "mine"


# Folders


def read_folder(path: Path) -> set[str]:
    """Return what the files of a folder say, all of which say the same if they are of one writer."""
    return {(path / str(number)).read_text() for number in range(3)}


@pytest.fixture(params=["exchanged", "renamed"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Take both ways in which a folder can be put in place of another one."""
    if request.param == "renamed":
        monkeypatch.setattr(atomic, "_exchange", lambda *_: False)


@pytest.mark.usefixtures("way")
def test_a_folder_is_made_and_replaced(tmp_path: Path) -> None:
    path = tmp_path / "new" / "folder"
    write_folder(path, "one")
    (path / "other").write_text("of the old folder")
    path.chmod(0o750)
    write_folder(path, "two")
    assert (names_in(path), read_folder(path), mode_of(path)) == (["0", "1", "2"], {"two"}, 0o750)
    (tmp_path / "link").symlink_to(path)
    write_folder(tmp_path / "link", "three")
    assert (tmp_path / "link").is_symlink()
    assert read_folder(path) == {"three"}
    (tmp_path / "empty").mkdir()
    write_folder(tmp_path / "empty", "four")
    assert names_in(tmp_path) == ["empty", "link", "new"]
    assert names_in(path.parent) == ["folder"]


@pytest.mark.usefixtures("way")
def test_a_file_is_no_folder_to_replace(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(InputError, match="Not a directory"):
        write_folder(tmp_path / "file", "one")
    assert (names_in(tmp_path), (tmp_path / "file").read_text()) == (["file"], "mine")


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux does")
def test_this_system_exchanges_folders(tmp_path: Path) -> None:
    """Without this the folder would be missing for an instant; the tests below would hardly notice."""
    for name in ("one", "two"):
        write_folder(tmp_path / name, name)
    assert atomic._exchange(tmp_path / "one", tmp_path / "two")
    assert (read_folder(tmp_path / "one"), read_folder(tmp_path / "two")) == ({"two"}, {"one"})
    assert not atomic._exchange(tmp_path / "one", tmp_path / "none")


# Several writers, some of which are killed


@pytest.mark.parametrize("folder", [False, True], ids=["file", "folder"])
def test_writers_at_once_never_mix_and_may_be_killed(folder: bool, tmp_path: Path) -> None:
    path = tmp_path / "target"
    texts = {text_of(letter) for letter in "abc"}
    context = multiprocessing.get_context("spawn")
    writers = [context.Process(target=write_on, args=(path, letter, folder)) for letter in "abc"]
    for writer in writers:
        writer.start()
    seen: set[str] = set()
    try:
        end = time.monotonic() + 60
        while not path.exists() or len(seen) < 2:
            assert time.monotonic() < end
            assert all(writer.is_alive() for writer in writers)
            if not path.exists():
                continue
            if not folder:
                seen.add(path.read_text())
            else:
                # Opened once, a folder stays the same one, whatever takes its place.
                number = os.open(path, os.O_RDONLY)
                try:
                    with os.fdopen(os.open("0", os.O_RDONLY, dir_fd=number)) as file:
                        seen.add(file.read())
                except FileNotFoundError:
                    pass  # It was replaced, and is being removed.
                finally:
                    os.close(number)
            assert seen <= texts
    finally:
        for writer in writers:
            writer.kill()
            writer.join()
    found = read_folder(path) if folder else {path.read_text()}
    assert len(found) == 1
    assert found <= texts
    # What the killed ones left is in nobody's way.
    if folder:
        write_folder(path, "last")
        assert read_folder(path) == {"last"}
    else:
        atomic.write_text(path, "last")
        assert path.read_text() == "last"


@pytest.mark.usefixtures("way")
def test_threads_replace_a_folder(tmp_path: Path) -> None:
    path = tmp_path / "folder"
    failures: list[BaseException] = []

    def write(text: str) -> None:
        try:
            for _ in range(40):
                write_folder(path, text)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=write, args=(text,)) for text in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    assert len(read_folder(path)) == 1
    assert names_in(tmp_path) == ["folder"]


def test_killed_in_the_middle_of_a_file(tmp_path: Path) -> None:
    """The process is stopped by the test while half of the file is written, and then killed."""
    path = tmp_path / "file"
    path.write_text("mine")
    code = (
        f"{WRITE} import time\n"
        f"with atomic.writing(Path({str(path)!r})) as file:\n"
        f"    file.write(bytes({BIG})); file.flush(); print('half', flush=True); time.sleep(60)\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "half\n"
        process.send_signal(signal.SIGKILL)
    assert path.read_text() == "mine"
    (left,) = tmp_path.glob(".*")
    assert left.stat().st_size == BIG
    atomic.write_text(path, "new")
    assert path.read_text() == "new"
