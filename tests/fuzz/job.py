"""One fuzzing process: ``python -m tests.fuzz.job TARGET FOLDER [libFuzzer options]``, started by `run`."""

import sys
from contextlib import suppress
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["p2sf", "p2sf_explorer", "tomllib"]):
    from tests.fuzz.seeds import seeds
    from tests.fuzz.targets import LAST, TARGETS

    for seed in (b"", *seeds(sys.argv[1])):  # what loads on first use is followed too, and charged to no input
        with suppress(AssertionError):  # atheris tells what it instruments on the stream that the target reads
            TARGETS[sys.argv[1]](seed)


def main() -> None:
    target = TARGETS[sys.argv[1]]

    with open(Path(sys.argv[2]).parent / LAST, "wb", buffering=0) as last:

        def once(data: bytes) -> None:
            last.seek(0)
            last.truncate()
            last.write(data)
            target(data)

        atheris.Setup([sys.argv[0], *sys.argv[2:]], once)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
