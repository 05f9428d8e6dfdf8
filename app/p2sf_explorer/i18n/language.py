"""The languages of the window: one Qt Linguist .ts file each in ``languages/``; English needs none.

To add a language, run ``python -m p2sf_explorer.i18n.extract LANGUAGE``, which writes its file, and translate that; run
again, it lists what is missing. What has no translation is shown in English.
"""

from pathlib import Path
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QObject, QTranslator

from p2sf_explorer.i18n.tr import CONTEXT, forget

FOLDER = Path(__file__).parent / "languages"
ENGLISH = "en"
NAMES = {ENGLISH: "English"}  # Qt would say of which country


class Translation(QTranslator):
    """A language read from its .ts file: no compiled file has to be kept beside it."""

    def __init__(self, code: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.code, self.texts = code, texts(code)

    def translate(self, context: str, source: str, disambiguation: str | None = None, n: int = -1) -> str | None:
        """Return one of our texts in the language, as it is where it has no translation; None for Qt's own texts."""
        return self.texts.get(source, source) if context == CONTEXT else None  # not "", which Qt would show

    def isEmpty(self) -> bool:
        """Return whether there are no translations: Qt asks before it installs."""
        return not self.texts


def texts(code: str) -> dict[str, str]:
    """Return the translation of each English text in a language; nothing for English."""
    path = FOLDER / f"{code}.ts"
    if not path.is_file():
        return {}
    messages = ElementTree.parse(path).iter("message")
    found = ((message.findtext("source"), message.findtext("translation")) for message in messages)
    return {source: text for source, text in found if source and text}


def languages() -> dict[str, str]:
    """Return the languages there are, code → its name in itself, English first."""
    codes = [ENGLISH, *sorted(path.stem for path in FOLDER.glob("*.ts"))]
    return {code: NAMES.get(code) or QLocale(code).nativeLanguageName().capitalize() for code in codes}


def language_of(choice: str) -> str:
    """Return the language meant by a State's ``language``: the system's for "system", English where there is none."""
    code = QLocale.system().name().split("_")[0] if choice == "system" else choice
    return code if (FOLDER / f"{code}.ts").is_file() else ENGLISH


def current_language() -> str:
    """Return the present language of the application."""
    application = QCoreApplication.instance()
    found = application.findChild(Translation) if application else None
    return found.code if found else ENGLISH


def set_language(choice: str) -> None:
    """Set the language of everything built from now on, and of Qt's own texts."""
    code, application = language_of(choice), QCoreApplication.instance()
    if application is None or code == current_language():
        return
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.setParent(None)
    if code != ENGLISH:
        own = QTranslator(application)
        own.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))
        for translator in (own, Translation(code, application)):
            application.installTranslator(translator)
    forget()
