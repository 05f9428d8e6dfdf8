"""Commands beside the window's own actions: panels, columns of a zoom, lenses, presets, colours, themes, languages."""

from collections.abc import Callable, Iterator
from functools import partial

from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QMenu

from p2sf_explorer.compute.quantities import RING_QUANTITIES
from p2sf_explorer.compute.setup import character, prescription, ranges, shipped_names, title
from p2sf_explorer.i18n.language import languages
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.panels import REGISTRY
from p2sf_explorer.state.what_if import PRESETS, of_preset
from p2sf_explorer.store.store import Store
from p2sf_explorer.widgets.command import Command

COLOURS = {"standard": "Inferno", "viridis": "Viridis", "cividis": "Cividis", "grey": "Grey"}
THEMES = {"system": "As the system", "light": "Light", "dark": "Dark"}
Panel = Callable[[str], object]
"""What is done with a panel by its key."""


def choices(
    store: Store, open_panel: Panel, take_stage: Panel, open_lens: Callable[[str], object]
) -> tuple[Command, ...]:
    """Return a command for every panel, lens, preset and appearance that a person may choose."""
    panels = (*_panels(open_panel, "Panel"), *_panels(take_stage, "On the stage"))
    return (*panels, *_rings(store), *_lenses(open_lens), *_presets(store), *appearances(store))


def _panels(show: Panel, group: str) -> Iterator[Command]:
    for entry in REGISTRY:
        yield Command(entry.title, partial(show, entry.key), (), group)


def _rings(store: Store) -> Iterator[Command]:
    """Yield a command for every column of a lens that zooms or focuses inside."""
    limits = ranges(prescription(store.state))
    for quantity in RING_QUANTITIES:
        for at, name in quantity.ticks(limits):
            yield Command(name, partial(store.update, **quantity.entries(at)), (), quantity.title)


def _lenses(open_lens: Callable[[str], object]) -> Iterator[Command]:
    for name in shipped_names():
        about = character(name)
        yield Command(title(name), partial(open_lens, name), (), "Lens", f"{name} {about} {tr(about)}")


def _presets(store: Store) -> Iterator[Command]:
    for preset in PRESETS:
        yield Command(preset.title, partial(store.update, **of_preset(preset)), (), "Preset")


def appearances(store: Store) -> Iterator[Command]:
    """Yield a command for every choice of colours, theme and language."""
    update = store.update
    for value in CHOICES["colours"]:
        yield Command(COLOURS[value], partial(update, colours=value), (), "Colours")
    for value in CHOICES["theme"]:
        yield Command(THEMES[value], partial(update, theme=value), (), "Theme")
    yield Command("As the system", partial(update, language="system"), (), "Language")
    for code, name in languages().items():
        english = QLocale.languageToString(QLocale(code).language())
        yield Command(name, partial(update, language=code), (), "Language", english)


def fill(menu: QMenu, store: Store, first: tuple[Command, ...]) -> None:
    """Put commands into a menu, and under them the appearances, group by group."""
    for command in first:
        keys = f"\t{command.keys[0]}" if command.keys else ""
        menu.addAction(tr(command.title) + keys, command.run)
    menu.addSeparator()
    groups: dict[str, QMenu] = {}
    for command in appearances(store):
        if command.group not in groups:
            groups[command.group] = menu.addMenu(tr(command.group))
        groups[command.group].addAction(tr(command.title), command.run)
