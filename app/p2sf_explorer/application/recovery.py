"""After a crash the next start begins anew, since what was on screen may be what ended it, and offers that back."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from PySide6.QtWidgets import QWidget

from p2sf_explorer.compute.setup import first_state
from p2sf_explorer.files.session import (
    Session,
    forget_rescued,
    last_session,
    rescue_session,
    rescued_sessions,
    take_rescued,
)
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.lessons.lesson import PERSONAL
from p2sf_explorer.lessons.offer import Offer
from p2sf_explorer.state.state import State, change, entry
from p2sf_explorer.store.store import Store

OFFER = "The explorer did not close properly. What was on screen, {lens} on {when}, has been kept."
TAKE_UP, TAKE_UP_TIP = "Restore it", "Show the window as it was; Ctrl+Z returns to this one"
GIVE_UP, GIVE_UP_TIP = "No, thanks", "Forget what was on screen when the explorer ended"


def session_to_open(asked: State | None, crashed: bool) -> Session:
    """Return the state and geometry to open: as ``asked``, else the last ones; after a crash, those of a first start.

    Theme, language, colours and the size of type stay.
    """
    if crashed:
        rescue_session()
    rescued = list(rescued_sessions().values())
    if asked is not None or not (crashed and rescued):
        return (asked, {}) if asked is not None else last_session()
    kept, geometry = rescued[0]
    return change(first_state(), **{name: entry(kept, name) for name in PERSONAL}), geometry


def offer_rescued(store: Store, put: Callable[[QWidget], None], window: QWidget) -> Offer | None:
    """Offer the windows of runs that crashed, one after the other, at each start until that is decided.

    ``put`` gives the line its place.
    """
    found = next(iter(rescued_sessions().items()), None)
    if found is None:
        return None
    path, (state, _) = found
    when = datetime.fromtimestamp(path.stat().st_mtime).strftime("%Y-%m-%d %H:%M")
    words = tr(OFFER, when=when, lens=Path(state.optics.lens).name)
    offer = Offer(words, TAKE_UP, TAKE_UP_TIP, GIVE_UP, GIVE_UP_TIP, window)
    offer.accept.clicked.connect(lambda: store.replace(state))
    offer.accept.clicked.connect(lambda: take_rescued(path))
    offer.dismiss.clicked.connect(lambda: forget_rescued(path))
    for button in (offer.accept, offer.dismiss):
        button.clicked.connect(lambda: offer_rescued(store, put, window))
    put(offer)
    offer.show()
    return offer
