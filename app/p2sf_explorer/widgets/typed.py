"""What a person types, in the language of the window."""

from p2sf_explorer.i18n.tr import decimal_separator
from p2sf_explorer.state.scales import one_reading


def typed(text: str) -> str:
    """Return a typed number as it is; P2SFError if it has two readings in the present language."""
    return one_reading(text, decimal_separator())
