"""Votes of a class, counted by hand before and after it has discussed a question. No Qt in here."""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Votes:
    """The places of the options that were voted for, from 0 in the order of the display, first vote and second."""

    first: tuple[int, ...] = ()
    second: tuple[int, ...] = ()
    again: bool = False  # whether the second vote is under way

    @property
    def counted(self) -> tuple[int, ...]:
        """Return the votes of the round that is under way."""
        return self.second if self.again else self.first

    def with_counted(self, places: tuple[int, ...]) -> "Votes":
        """Return this with other votes in the round that is under way."""
        return replace(self, second=places) if self.again else replace(self, first=places)

    def of(self, place: int) -> tuple[int, int]:
        """Return how many voted for an option, at first and after the discussion."""
        return self.first.count(place), self.second.count(place)
