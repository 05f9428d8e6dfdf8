"""The language of the window changes, and back: apart from the tests of one German window, which must stay German."""

import pytest
from PySide6.QtCore import QCoreApplication

from p2sf_explorer.application.language_switch import LanguageSwitch
from p2sf_explorer.i18n.language import current_language, set_language
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import new_state
from p2sf_explorer.window.window import MainWindow


def test_qts_own_words_are_its_own_or_its_translators(qapp):
    set_language("de")
    try:
        assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Abbrechen"
        assert QCoreApplication.translate("nobody's", "words %1") == "words %1"
    finally:
        set_language("en")
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Cancel"


@pytest.mark.slow
def test_a_change_of_language_reopens_the_window_and_undo_brings_it_back(only_window, qtbot):
    def made(state):
        return MainWindow(state, measured=False)

    switch = LanguageSwitch(new_state(method="seidel", language="en"), made)
    try:
        first = switch.window
        first.store.update(field_deg=7.0)
        first.store.update(language="de")
        switch.reopen()
        assert current_language() == "de" and tr("Undo") == "Rückgängig"
        assert switch.window is not first and switch.window.top.undo.accessibleName() == "Rückgängig"
        switch.window.store.undo()
        switch.reopen()
        assert current_language() == "en" and switch.window.top.undo.accessibleName() == "Undo"
        switch.window.store.undo()
        assert switch.window.store.state.optics.field_deg == 10.0
    finally:
        set_language("en")
        switch.window.close()
