"""One fuzzing process: ``python -m tests.fuzz.job TARGET FOLDER [libFuzzer options]``, started by `run`."""

import sys

import atheris

with atheris.instrument_imports(include=["p2sf", "tomllib"]):
    from tests.fuzz.targets import TARGETS


def main() -> None:
    target = TARGETS[sys.argv[1]]
    target(b"")  # imports what loads on first use, so that no input is charged for it

    def once(data: bytes) -> None:
        target(data)

    atheris.Setup([sys.argv[0], *sys.argv[2:]], once)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
