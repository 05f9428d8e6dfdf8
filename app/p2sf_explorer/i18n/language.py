"""The languages of the window: one Qt .ts file each in this folder, as Qt Linguist writes them; English needs none.

Adding a language is adding a file: copy ``de.ts``, name it after the language, translate it.
"""

import re
from pathlib import Path
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QObject, QTranslator

from p2sf_explorer.i18n.tr import CONTEXT, forget

FOLDER = Path(__file__).parent / "languages"
ENGLISH = "en"
BRACES, WORD = re.compile(r"\{\w*\}"), re.compile(r"[^\W\d_]{2}")
JOINTS = re.compile(r"(<[^>]*>|&nbsp;| · |   ⚠ |^⚠ |\n)")  # what stands between sentences on one line
CLAUSES = re.compile(r"(; )")  # and between what is wrong and what to do
ANYTHING = r"((?:(?! · |\n).)+?)"  # what may stand for a name in braces,
WITHIN = r"((?:(?! · |\n|; ).)+?)"  # for one in a clause,
FIGURE = r"([-−+]?[\d.∞][^\s;]*)"  # for {number} and {count}, and for {path}
PATH = r"([^;\n]*?[./\\][^;\n]*?)"
PLACE = re.compile(r"\{(\d+)\}")
STANDS = {"{number}": FIGURE, "{count}": FIGURE, "{path}": PATH, "{why}": ANYTHING}  # a reason has clauses of its own
NAMES = {ENGLISH: "English"}  # Qt would say of which country


class Translation(QTranslator):
    """A language read from its .ts file: no compiled file has to be kept beside it."""

    def __init__(self, code: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.code, self.texts = code, texts(code)
        # The more of a template is fixed, the sooner it is tried: "{count} wavelengths" fits the end of much.
        braced = sorted((source for source in self.texts if "{" in source), key=lambda s: -len(BRACES.sub("", s)))
        self.templates = tuple(template(source, self.texts[source]) for source in braced)

    def translate(self, context: str, source: str, disambiguation: str | None = None, n: int = -1) -> str | None:
        """Return one of our texts in the language, as it is where the language has nothing; nothing for Qt's own."""
        return self.said(source) if context == CONTEXT else None  # not "": Qt would show that

    def said(self, source: str) -> str:
        """Return a text in the language: as it stands there, or by the first template it fits, else piece by piece."""
        bare = source.strip(" ")
        if bare != source:
            return source.replace(bare, self.said(bare), 1) if bare else source
        found = self.texts.get(source)
        if found is None and WORD.search(source):
            small = source[0].lower() + source[1:]  # a sentence that is known from the middle of another
            said = self.texts.get(small) or self._by_template(source) or self._by_template(small)
            found = said and said[0].upper() + said[1:] if source != small else said
        if found is None:
            joints = JOINTS if JOINTS.search(source) else CLAUSES
            pieces = joints.split(source)  # every second one is a joint
            pieces[::2] = map(self.said, pieces[::2]) if len(pieces) > 1 else pieces
            found = "".join(pieces)
        return found

    def _by_template(self, source: str) -> str | None:
        for form, said in self.templates:
            fit = form(source)
            if fit:
                return filled(said, [self.said(value) for value in fit.groups()])
        return None

    def isEmpty(self) -> bool:
        """Return whether there is nothing in it: Qt asks before it installs."""
        return not self.texts


def filled(said: str, values: list[str]) -> str:
    """Return a translation with values in its numbered braces; other braces are its own."""
    return PLACE.sub(lambda place: values[int(place[1])], said)


def template(source: str, said: str):
    """Return what tells whether a text fits a source with braces, and the translation, its braces numbered alike."""
    names = BRACES.findall(source)
    parts = re.split(r"(\{\w*\})", source)
    anything = ANYTHING if "; " in source else WITHIN
    form = "".join(STANDS.get(p, anything) if p in names else re.escape(p) for p in parts)
    for number, name in enumerate(names):
        said = said.replace(name, f"{{{number}}}", 1)
    fits, fixed, dots = (
        re.compile(form).fullmatch,
        max((p for p in parts if p not in names), key=len),
        source.count(" · "),
    )
    # Most texts lack the words, or have other parts: no need to match them, which takes long.
    return lambda text: fits(text) if fixed in text and text.count(" · ") == dots else None, said


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
