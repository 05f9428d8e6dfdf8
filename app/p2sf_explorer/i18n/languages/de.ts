<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
<name>p2sf</name>
<message><source>0.7 of the pupil</source><translation>0.7 der Pupille</translation></message>
<message><source>1/depth, 1/m (0 is ∞)</source><translation>1/Abstand, 1/m (0 ist ∞)</translation></message>
<message><source>16 µm pixels</source><translation>16-µm-Pixel</translation></message>
<message><source>32 µm pixels</source><translation>32-µm-Pixel</translation></message>
<message><source>3D</source><translation>3D</translation></message>
<message><source>3D needs OpenGL, and none works here; install a driver or Mesa's software renderer (apt-get install libegl1 libgl1-mesa-dri), then open this panel again</source><translation>3D braucht OpenGL, und hier läuft keines; einen Treiber oder Mesas Software-Renderer installieren (apt-get install libegl1 libgl1-mesa-dri), dann diese Ansicht wieder öffnen</translation></message>
<message><source>3D needs pyvista, which is not installed; run pip install pyvista, then open this panel again</source><translation>3D braucht pyvista, das nicht installiert ist; pip install pyvista ausführen, dann diese Ansicht wieder öffnen</translation></message>
<message><source>3D: elements of revolution to their clear rims; the wavefront is W·λ ahead of the sphere about the image point.</source><translation>3D: Drehkörper bis zu ihren freien Rändern; die Wellenfront ist der Kugel um den Bildpunkt um W·λ voraus.</translation></message>
<message><source>4 µm pixels</source><translation>4-µm-Pixel</translation></message>
<message><source>8 µm pixels</source><translation>8-µm-Pixel</translation></message>
<message><source>?</source><translation>?</translation></message>
<message><source>A</source><translation>A</translation></message>
<message><source>A and B are the same: move a control, or choose another lens or method</source><translation>A und B sind gleich: bewegen Sie einen Regler oder wählen Sie ein anderes Objektiv oder Verfahren</translation></message>
<message><source>A field of {angle} is far outside the paraxial range, where six coefficients only sketch the PSF; choose fitted or traced.</source><translation>Ein Feld von {angle} liegt weit außerhalb des paraxialen Bereichs, wo sechs Koeffizienten die PSF nur skizzieren; fitted oder traced wählen.</translation></message>
<message><source>A − B</source><translation>A − B</translation></message>
<message><source>A − B · at most {share} % of the higher peak</source><translation>A − B · höchstens {share} % der höheren Spitze</translation></message>
<message><source>A − B, share of the higher peak</source><translation>A − B, Anteil der höheren Spitze</translation></message>
<message><source>Aberrations</source><translation>Aberrationen</translation></message>
<message><source>Accept substitutes</source><translation>Ersatz annehmen</translation></message>
<message><source>Accuracy</source><translation>Genauigkeit</translation></message>
<message><source>Accuracy: R² = 1 − Σ(reference − PSF)²/Σ(reference − mean)² against a converged sum of traced rays (Huygens).</source><translation>Genauigkeit: R² = 1 − Σ(Referenz − PSF)²/Σ(Referenz − Mittel)² gegen eine auskonvergierte Summe verfolgter Strahlen (Huygens).</translation></message>
<message><source>Added waves</source><translation>Hinzugefügte Wellen</translation></message>
<message><source>Airy</source><translation>Airy</translation></message>
<message><source>Airy radius</source><translation>Airy-Radius</translation></message>
<message><source>Airy radius, the circle</source><translation>Airy-Radius, der Kreis</translation></message>
<message><source>All</source><translation>Alle</translation></message>
<message><source>All at once</source><translation>Alles zugleich</translation></message>
<message><source>An aperture of NA {na} is far outside the paraxial range, where six coefficients only sketch the PSF; choose fitted or traced.</source><translation>Eine Öffnung von NA {na} liegt weit außerhalb des paraxialen Bereichs, wo sechs Koeffizienten die PSF nur skizzieren; fitted oder traced wählen.</translation></message>
<message><source>Animated GIF (*.gif);;Numbered PNG frames (*.png)</source><translation>Animiertes GIF (*.gif);;Nummerierte PNG-Bilder (*.png)</translation></message>
<message><source>Arrow keys or the first letters find a lens, Enter opens it. Your own files: Ctrl+O.</source><translation>Pfeiltasten oder die ersten Buchstaben finden ein Objektiv, Enter öffnet es. Eigene Dateien: Strg+O.</translation></message>
<message><source>As the system</source><translation>Wie das System</translation></message>
<message><source>Aspheric plano-convex condenser, f/2 (synthetic)</source><translation>Asphärischer plankonvexer Kondensor, f/2 (synthetisch)</translation></message>
<message><source>Aspheric terms A4·r⁴ + A6·r⁶ + …, with spaces between.</source><translation>Asphärische Glieder A4·r⁴ + A6·r⁶ + …, mit Leerzeichen dazwischen.</translation></message>
<message><source>Astigmatism, 1 λ, medial focus</source><translation>Astigmatismus, 1 λ, mittlerer Fokus</translation></message>
<message><source>Astigmatism, 2 λ, sagittal focus</source><translation>Astigmatismus, 2 λ, sagittaler Fokus</translation></message>
<message><source>Astigmatism, 2 λ, tangential focus</source><translation>Astigmatismus, 2 λ, tangentialer Fokus</translation></message>
<message><source>Atlas of PSFs over depth and field</source><translation>Atlas der PSFs über Abstand und Feld</translation></message>
<message><source>Autofocus: best RMS wavefront</source><translation>Autofokus: kleinster RMS von W</translation></message>
<message><source>B</source><translation>B</translation></message>
<message><source>B is on screen, and the controls move A; show A, or swap the two, to change this one</source><translation>B ist zu sehen, und die Regler bewegen A; A zeigen oder beide tauschen, um dieses zu ändern</translation></message>
<message><source>Back</source><translation>Zurück</translation></message>
<message><source>Back focus F′</source><translation>Bildseitiger Brennpunkt F′</translation></message>
<message><source>Back to file</source><translation>Zurück zur Datei</translation></message>
<message><source>Back to the lens's own coefficients: nothing added, muted or solo</source><translation>Zurück zu den Koeffizienten des Objektivs: nichts hinzugefügt, stumm oder solo</translation></message>
<message><source>Best-form singlet f/6, 20 mm</source><translation>Einzellinse bester Form f/6, 20 mm</translation></message>
<message><source>Brightness scale</source><translation>Helligkeitsskala</translation></message>
<message><source>Cancel</source><translation>Abbrechen</translation></message>
<message><source>Cemented achromat f/6, 20 mm</source><translation>Verkitteter Achromat f/6, 20 mm</translation></message>
<message><source>Centroid y</source><translation>Schwerpunkt y</translation></message>
<message><source>Checkerboard</source><translation>Schachbrett</translation></message>
<message><source>Choose a PNG or TIFF to photograph</source><translation>Ein PNG oder TIFF zum Fotografieren wählen</translation></message>
<message><source>Choose a shipped lens…</source><translation>Mitgeliefertes Objektiv wählen …</translation></message>
<message><source>Chromatic shift</source><translation>Farblängsfehler</translation></message>
<message><source>Cividis</source><translation>Cividis</translation></message>
<message><source>Clear rim, mm; ∞ is unlimited. On the stop it is the aperture.</source><translation>Freier Rand, mm; ∞ ist unbegrenzt. An der Blende ist er die Öffnung.</translation></message>
<message><source>Click or press Enter to make this surface the stop; the f-number stays.</source><translation>Klicken oder Enter macht diese Fläche zur Blende; die Blendenzahl bleibt.</translation></message>
<message><source>Clip at rims</source><translation>Randbeschnitt</translation></message>
<message><source>Clip: rays beyond a clear semi-diameter are lost, which vignettes the pupil off axis.</source><translation>Randbeschnitt: Strahlen jenseits eines freien Halbmessers gehen verloren; das vignettiert die Pupille außerhalb der Achse.</translation></message>
<message><source>Close</source><translation>Schließen</translation></message>
<message><source>Close the window</source><translation>Fenster schließen</translation></message>
<message><source>Coarse</source><translation>Grob</translation></message>
<message><source>Coefficients</source><translation>Koeffizienten</translation></message>
<message><source>Colour</source><translation>Farbe</translation></message>
<message><source>Colour PSF</source><translation>Farbige PSF</translation></message>
<message><source>Colour PSF: a PSF for each wavelength where its own chief ray lands, weighted by the spectrum and the CIE 1931 observer, as linear sRGB. Right: the luminance of the spectrum, and where each colour's chief ray lands.</source><translation>Farbige PSF: eine PSF je Wellenlänge dort, wo ihr eigener Hauptstrahl landet, gewichtet mit Spektrum und CIE-Beobachter 1931, als lineares sRGB. Rechts: die Leuchtdichte des Spektrums und wo der Hauptstrahl jeder Farbe landet.</translation></message>
<message><source>Colour blue</source><translation>Farbe Blau</translation></message>
<message><source>Colour green</source><translation>Farbe Grün</translation></message>
<message><source>Colour red</source><translation>Farbe Rot</translation></message>
<message><source>Colours</source><translation>Farben</translation></message>
<message><source>Coma, 3 λ</source><translation>Koma, 3 λ</translation></message>
<message><source>Coma, ½ λ</source><translation>Koma, ½ λ</translation></message>
<message><source>Compare</source><translation>Vergleich</translation></message>
<message><source>Conic K</source><translation>Konik K</translation></message>
<message><source>Conic constant K = −e²: 0 a sphere, −1 a paraboloid.</source><translation>Kegelschnittkonstante K = −e²: 0 eine Kugel, −1 ein Paraboloid.</translation></message>
<message><source>Cooke triplet, f/5, 50 mm, 40 degree field</source><translation>Cooke-Triplet, f/5, 50 mm, 40 Grad Feld</translation></message>
<message><source>Copied a link of {count} letters; paste it into a window of the explorer</source><translation>Link aus {count} Zeichen kopiert; in ein Fenster des Explorers einfügen</translation></message>
<message><source>Copy a link to what is on screen</source><translation>Link auf das Gezeigte kopieren</translation></message>
<message><source>Copy data as CSV</source><translation>Daten als CSV kopieren</translation></message>
<message><source>Copy link</source><translation>Link kopieren</translation></message>
<message><source>Copy picture</source><translation>Bild kopieren</translation></message>
<message><source>Copy the panel's data as CSV</source><translation>Daten der Ansicht als CSV kopieren</translation></message>
<message><source>Copy the panel's picture</source><translation>Bild der Ansicht kopieren</translation></message>
<message><source>Dark</source><translation>Dunkel</translation></message>
<message><source>Database</source><translation>Datenbank</translation></message>
<message><source>Database: every coefficient over depth and field at this wavelength, as polynomials exact to round-off; drag on a map or the atlas, or use the arrow keys and Enter, to set the source.</source><translation>Datenbank: jeder Koeffizient über Abstand und Feld bei dieser Wellenlänge, als Polynome bis auf Rundung genau; Ziehen auf Karte oder Atlas, oder Pfeiltasten und Enter, setzen die Quelle.</translation></message>
<message><source>Defocus is {wd} λ, beyond the method's 10 λ; bring focus or source nearer, or stop down.</source><translation>Der Defokus ist {wd} λ, jenseits der 10 λ der Methode; Fokus oder Quelle näher bringen oder abblenden.</translation></message>
<message><source>Defocus, 1 λ</source><translation>Defokus, 1 λ</translation></message>
<message><source>Delete</source><translation>Löschen</translation></message>
<message><source>Depth</source><translation>Objektabstand</translation></message>
<message><source>Depth of field</source><translation>Schärfentiefe</translation></message>
<message><source>Depth of field: depths whose blur is no wider than what is tolerated. Paraxial: diameter of the axial point's cone on the sensor, linear in 1/distance. Exact rays: twice the RMS radius of the spot at the present field.</source><translation>Schärfentiefe: Abstände, deren Unschärfe nicht breiter als erlaubt ist. Paraxial: Durchmesser des Kegels des Achspunkts auf dem Sensor, linear in 1/Abstand. Exakte Strahlen: doppelter RMS-Radius des Spots am jetzigen Feld.</translation></message>
<message><source>Depth: distance from the source to the first vertex. The slider is even in vergence, 1/depth.</source><translation>Objektabstand: von der Quelle bis zum ersten Scheitel. Der Regler ist gleichmäßig in der Vergenz, 1/Abstand.</translation></message>
<message><source>Depths</source><translation>Abstände</translation></message>
<message><source>Deutsch</source><translation>Deutsch</translation></message>
<message><source>Diameter, and place from the first vertex.</source><translation>Durchmesser, und Ort vom ersten Scheitel.</translation></message>
<message><source>Diameter, and place from the last vertex.</source><translation>Durchmesser, und Ort vom letzten Scheitel.</translation></message>
<message><source>Diffraction-limited: RMS {rms} λ</source><translation>Beugungsbegrenzt: RMS {rms} λ</translation></message>
<message><source>Dismiss</source><translation>Ausblenden</translation></message>
<message><source>Distance to the next vertex, mm; the last one to the sensor.</source><translation>Abstand zum nächsten Scheitel, mm; der letzte zum Sensor.</translation></message>
<message><source>Double Gauss, 28 degree field, f/3, 100 mm</source><translation>Doppel-Gauß, 28 Grad Feld, f/3, 100 mm</translation></message>
<message><source>Drag a slider: lens, pupil and PSF follow. Hover over a name for its definition.</source><translation>Einen Regler ziehen: Objektiv, Pupille und PSF folgen. Über einem Namen steht seine Definition.</translation></message>
<message><source>Drag or use the arrow keys to turn the surface; a double-click goes back</source><translation>Ziehen oder die Pfeiltasten drehen die Fläche; ein Doppelklick führt zurück</translation></message>
<message><source>Drop every edit and take the lens as its file has it</source><translation>Alle Änderungen verwerfen und das Objektiv nehmen, wie es in der Datei steht</translation></message>
<message><source>Each PSF over its own peak, {scale}; W11 moves the image and is left out.</source><translation>Jede PSF über ihrer eigenen Spitze, {scale}; W11 verschiebt das Bild und ist weggelassen.</translation></message>
<message><source>Effective focal length f′ = −1/C of the system matrix.</source><translation>Brennweite f′ = −1/C der Systemmatrix.</translation></message>
<message><source>EnP</source><translation>EnP</translation></message>
<message><source>English</source><translation>English</translation></message>
<message><source>Entrance pupil</source><translation>Eintrittspupille</translation></message>
<message><source>Error</source><translation>Fehler</translation></message>
<message><source>Every panel by its group (Alt+0)</source><translation>Jede Ansicht nach ihrer Gruppe (Alt+0)</translation></message>
<message><source>ExP</source><translation>ExP</translation></message>
<message><source>Exchange A and B</source><translation>A und B vertauschen</translation></message>
<message><source>Exchange A and B: the controls then move the other one</source><translation>A und B vertauschen: die Regler bewegen dann das andere</translation></message>
<message><source>Exit</source><translation>Beenden</translation></message>
<message><source>Exit pupil</source><translation>Austrittspupille</translation></message>
<message><source>F-number</source><translation>Blendenzahl</translation></message>
<message><source>Farthest ray</source><translation>Fernster Strahl</translation></message>
<message><source>Fast double Gauss f/1.4, 50 mm</source><translation>Lichtstarker Doppel-Gauß f/1.4, 50 mm</translation></message>
<message><source>Field</source><translation>Feld</translation></message>
<message><source>Field angle</source><translation>Feldwinkel</translation></message>
<message><source>Field curvature: where sagittal (S) and tangential (T) rays come to focus. Distortion: (real − paraxial image height)/paraxial. Thick: exact rays, fine: third order (W22, W20, W11).</source><translation>Bildfeldwölbung: wo sagittale (S) und tangentiale (T) Strahlen zum Fokus kommen. Verzeichnung: (wahre − paraxiale Bildhöhe)/paraxiale. Dick: exakte Strahlen, fein: dritte Ordnung (W22, W20, W11).</translation></message>
<message><source>Field curves</source><translation>Feldkurven</translation></message>
<message><source>Field map</source><translation>Feldkarte</translation></message>
<message><source>Field map: the PSF all over a 3:2 picture whose corner is the field's edge, each over its own peak and turned as its field is. Click a picture, or choose it by the arrow keys and Enter, to go to its field; a frame marks the present one.</source><translation>Feldkarte: die PSF über ein ganzes 3:2-Bild, dessen Ecke der Feldrand ist, jede über ihrer eigenen Spitze und gedreht wie ihr Feld. Ein Klick auf ein Bild, oder Pfeiltasten und Enter, gehen zu seinem Feld; ein Rahmen zeigt das jetzige.</translation></message>
<message><source>Field: angle of the chief ray at the entrance pupil; image height is about f′·tan(field).</source><translation>Feld: Winkel des Hauptstrahls an der Eintrittspupille; die Bildhöhe ist etwa f′·tan(Feld).</translation></message>
<message><source>Files</source><translation>Dateien</translation></message>
<message><source>Film…</source><translation>Film …</translation></message>
<message><source>Find a command, a panel, a lens or a preset</source><translation>Befehl, Ansicht, Objektiv oder Vorgabe finden</translation></message>
<message><source>Find a command…</source><translation>Befehl finden …</translation></message>
<message><source>First dark ring of a perfect lens, 0.61 λ/NA.</source><translation>Erster dunkler Ring eines perfekten Objektivs, 0.61 λ/NA.</translation></message>
<message><source>First order</source><translation>Erste Ordnung</translation></message>
<message><source>First-order data</source><translation>Daten erster Ordnung</translation></message>
<message><source>First-order data: everything that follows from paraxial rays alone; hover over a row for its definition.</source><translation>Daten erster Ordnung: alles, was allein aus paraxialen Strahlen folgt; über einer Zeile steht ihre Definition.</translation></message>
<message><source>Focal length f′</source><translation>Brennweite f′</translation></message>
<message><source>Focus at infinity</source><translation>Auf unendlich einstellen</translation></message>
<message><source>Focus distance</source><translation>Fokus auf</translation></message>
<message><source>beyond ∞</source><translation>hinter ∞</translation></message>
<message><source>Focus distance: the sensor sits at the paraxial image of this distance, 1/s′ = 1/f′ − 1/s. beyond ∞: nearer to the lens than the image of infinity.</source><translation>Fokus auf: der Sensor steht im paraxialen Bild dieses Abstands, 1/s′ = 1/f′ − 1/s. hinter ∞: näher am Objektiv als das Bild von Unendlich.</translation></message>
<message><source>Free pupil</source><translation>Freie Pupille</translation></message>
<message><source>Free pupil: the six sliders alone make the wavefront, without the lens's own coefficients.</source><translation>Freie Pupille: allein die sechs Regler machen die Wellenfront, ohne die Koeffizienten des Objektivs.</translation></message>
<message><source>Front focus F</source><translation>Objektseitiger Brennpunkt F</translation></message>
<message><source>Glass or index</source><translation>Glas oder Index</translation></message>
<message><source>Grey</source><translation>Grau</translation></message>
<message><source>Help</source><translation>Hilfe</translation></message>
<message><source>How the phase is shown</source><translation>Wie die Phase gezeigt wird</translation></message>
<message><source>Hyper</source><translation>Hyper</translation></message>
<message><source>Image</source><translation>Bild</translation></message>
<message><source>Image height</source><translation>Bildhöhe</translation></message>
<message><source>Image: Σ over the scene's points of brightness × PSF at that point, for red, green and blue; distortion and falling light included.</source><translation>Bild: Σ über die Punkte der Szene von Helligkeit × PSF an diesem Punkt, für Rot, Grün und Blau; Verzeichnung und Lichtabfall eingeschlossen.</translation></message>
<message><source>Import</source><translation>Import</translation></message>
<message><source>Import report</source><translation>Importbericht</translation></message>
<message><source>Import report: everything the reader of the lens file took, replaced, passed over or refused, and why.</source><translation>Importbericht: alles, was der Leser der Objektivdatei nahm, ersetzte, überging oder ablehnte, und warum.</translation></message>
<message><source>In its own window, or back</source><translation>In einem eigenen Fenster, oder zurück</translation></message>
<message><source>Inferno</source><translation>Inferno</translation></message>
<message><source>Insert after</source><translation>Einfügen danach</translation></message>
<message><source>It only moves the image.</source><translation>Sie verschiebt nur das Bild.</translation></message>
<message><source>Lagrange invariant</source><translation>Lagrange-Invariante</translation></message>
<message><source>Lagrange invariant H = {h} mm</source><translation>Lagrange-Invariante H = {h} mm</translation></message>
<message><source>Landscape</source><translation>Landschaft</translation></message>
<message><source>Language</source><translation>Sprache</translation></message>
<message><source>Largest blur diameter on the sensor that is still called sharp.</source><translation>Größter Unschärfedurchmesser auf dem Sensor, der noch scharf heißt.</translation></message>
<message><source>Layout</source><translation>Aufbau</translation></message>
<message><source>Left: sections of the PSF through the chief ray, over its own peak; grey: the Airy pattern (2J₁(v)/v)². Right: encircled energy, the share of the window's light within a radius of its centroid; grey: a perfect lens.</source><translation>Links: Schnitte der PSF durch den Hauptstrahl, über ihrer eigenen Spitze; grau: die Airy-Figur (2J₁(v)/v)². Rechts: eingeschlossene Energie, der Anteil des Lichts im Fenster innerhalb eines Radius um den Schwerpunkt; grau: ein perfektes Objektiv.</translation></message>
<message><source>Lens</source><translation>Objektiv</translation></message>
<message><source>Lens "{name}" is neither shipped nor a file; did you mean {other}?</source><translation>Das Objektiv "{name}" ist weder mitgeliefert noch eine Datei; ist {other} gemeint?</translation></message>
<message><source>Lens: one row per surface in the order light meets them; type into a cell, Ctrl+Z takes it back.</source><translation>Objektiv: eine Zeile je Fläche in der Reihenfolge des Lichts; in eine Zelle tippen, Strg+Z nimmt es zurück.</translation></message>
<message><source>Lens…</source><translation>Objektiv …</translation></message>
<message><source>Lesson</source><translation>Lektion</translation></message>
<message><source>Lessons</source><translation>Lernen</translation></message>
<message><source>Lessons, from a point of light to a photograph: begin or leave (F3)</source><translation>Lektionen, vom Lichtpunkt zum Foto: beginnen oder verlassen (F3)</translation></message>
<message><source>Begin or leave a lesson</source><translation>Lektion beginnen oder verlassen</translation></message>
<message><source>Light</source><translation>Hell</translation></message>
<message><source>Light or dark</source><translation>Hell oder dunkel</translation></message>
<message><source>Link</source><translation>Koppeln</translation></message>
<message><source>Link all</source><translation>Alles koppeln</translation></message>
<message><source>Link none</source><translation>Nichts koppeln</translation></message>
<message><source>Link: {count}</source><translation>Gekoppelt: {count}</translation></message>
<message><source>Longitudinal chromatic shift: how far behind the sensor rays of each colour cross the axis, paraxial ones and exact ones from 0.7 and from the rim of the pupil. The band is ±n′λ/(2NA²), within which diffraction hides it.</source><translation>Farblängsfehler: wie weit hinter dem Sensor Strahlen jeder Farbe die Achse schneiden, paraxiale und exakte aus 0.7 und vom Rand der Pupille. Das Band ist ±n′λ/(2NA²), innerhalb dessen ihn die Beugung verbirgt.</translation></message>
<message><source>MTF</source><translation>MTF</translation></message>
<message><source>MTF: contrast left of a sine pattern, |FT of the PSF|; grey: a perfect lens, (2/π)(acos ν − ν√(1−ν²)).</source><translation>MTF: Kontrast, der von einem Sinusmuster bleibt, |FT der PSF|; grau: ein perfektes Objektiv, (2/π)(acos ν − ν√(1−ν²)).</translation></message>
<message><source>Magnification</source><translation>Abbildungsmaßstab</translation></message>
<message><source>Method</source><translation>Methode</translation></message>
<message><source>Method: what describes the PSF; auto takes the cheapest whose predicted R² against Huygens is enough.</source><translation>Methode: was die PSF beschreibt; auto nimmt die billigste, deren vorhergesagtes R² gegen Huygens genügt.</translation></message>
<message><source>More</source><translation>Mehr</translation></message>
<message><source>Most of all {what}: {share} % of the wavefront variance</source><translation>Am meisten {what}: {share} % der Varianz der Wellenfront</translation></message>
<message><source>Mostly {what}: {share} % of the wavefront variance</source><translation>Meist {what}: {share} % der Varianz der Wellenfront</translation></message>
<message><source>Move the sensor to where the RMS of W over the pupil is smallest (Ctrl+F).</source><translation>Den Sensor dorthin setzen, wo der RMS von W über die Pupille am kleinsten ist (Strg+F).</translation></message>
<message><source>Mute: this term counts as zero (M)</source><translation>Stumm: dieser Term zählt als null (M)</translation></message>
<message><source>NA = n′|u′|, image-space slope of the marginal ray.</source><translation>NA = n′|u′|, bildseitige Steigung des Randstrahls.</translation></message>
<message><source>Navarro wide-angle schematic eye, 543 nm</source><translation>Schematisches Weitwinkelauge nach Navarro, 543 nm</translation></message>
<message><source>Next</source><translation>Weiter</translation></message>
<message><source>Next lesson</source><translation>Nächste Lektion</translation></message>
<message><source>Next step of the lesson</source><translation>Nächster Schritt der Lektion</translation></message>
<message><source>No aberration</source><translation>Keine Aberration</translation></message>
<message><source>No ray reaches the sensor; choose a smaller field, stop down, or leave clipping off</source><translation>Kein Strahl erreicht den Sensor; ein kleineres Feld wählen, abblenden oder den Randbeschnitt auslassen</translation></message>
<message><source>No ray reaches the sensor; choose a smaller field or stop down</source><translation>Kein Strahl erreicht den Sensor; ein kleineres Feld wählen oder abblenden</translation></message>
<message><source>No ray reaches the sensor; this lens is for near objects, so choose a nearer depth</source><translation>Kein Strahl erreicht den Sensor; dieses Objektiv ist für nahe Objekte, also eine nähere Tiefe wählen</translation></message>
<message><source>Nodal point N</source><translation>Knotenpunkt N</translation></message>
<message><source>Nodal point N′</source><translation>Knotenpunkt N′</translation></message>
<message><source>Nothing fits; try fewer letters.</source><translation>Nichts passt; weniger Buchstaben versuchen.</translation></message>
<message><source>Numerical aperture</source><translation>Numerische Apertur</translation></message>
<message><source>Nyquist {f}</source><translation>Nyquist {f}</translation></message>
<message><source>OPD fan</source><translation>OPD-Fächer</translation></message>
<message><source>OPD fan: (optical path of the chief ray − of the ray)/λ for exact rays, tilt included.</source><translation>OPD-Fächer: (optischer Weg des Hauptstrahls − des Strahls)/λ für exakte Strahlen, mit Kippung.</translation></message>
<message><source>OPD, waves</source><translation>OPD, Wellen</translation></message>
<message><source>Object height</source><translation>Objekthöhe</translation></message>
<message><source>One of the drawn rays cannot pass (surface missed, or total reflection); less light arrives than the picture assumes.</source><translation>Einer der gezeichneten Strahlen kommt nicht durch (Fläche verfehlt oder totale Reflexion); es kommt weniger Licht an, als das Bild annimmt.</translation></message>
<message><source>Open in its own window (double-click the tab or drag it out, or Ctrl+D)</source><translation>In einem eigenen Fenster öffnen (Doppelklick auf den Reiter oder ihn herausziehen, oder Strg+D)</translation></message>
<message><source>Open</source><translation>Öffnen</translation></message>
<message><source>Open a file…</source><translation>Datei öffnen …</translation></message>
<message><source>Open a lens file or a saved state (Ctrl+O), or one of the latest</source><translation>Objektivdatei oder gespeicherten Zustand öffnen (Strg+O), oder eine der letzten</translation></message>
<message><source>Open a lens file or a saved state…</source><translation>Objektivdatei oder gespeicherten Zustand öffnen …</translation></message>
<message><source>Open a lens or a state</source><translation>Objektiv oder Zustand öffnen</translation></message>
<message><source>Open in its own window (double-click the tab, or Ctrl+D)</source><translation>Im eigenen Fenster öffnen (Doppelklick auf das Blatt oder Strg+D)</translation></message>
<message><source>Open the file with the substitute glasses listed; the lens then counts as edited</source><translation>Die Datei mit den aufgeführten Ersatzgläsern öffnen; das Objektiv gilt dann als bearbeitet</translation></message>
<message><source>Open the lens as its file has it</source><translation>Öffnung wie in der Datei</translation></message>
<message><source>PSF</source><translation>PSF</translation></message>
<message><source>PSF data or window…</source><translation>PSF-Daten oder Fenster …</translation></message>
<message><source>PSF over the field</source><translation>PSF über das Feld</translation></message>
<message><source>PSF profiles</source><translation>PSF-Profile</translation></message>
<message><source>PSF × {psf} wide, height: {scale}</source><translation>PSF × {psf} breit, Höhe: {scale}</translation></message>
<message><source>PSF, peak = 1</source><translation>PSF, Spitze = 1</translation></message>
<message><source>PSF, perfect peak = 1</source><translation>PSF, perfekte Spitze = 1</translation></message>
<message><source>PSF, sum = 1</source><translation>PSF, Summe = 1</translation></message>
<message><source>PSFs, {wide} µm wide, √ of peak = 1</source><translation>PSFs, {wide} µm breit, √ mit Spitze = 1</translation></message>
<message><source>Panel</source><translation>Ansicht</translation></message>
<message><source>Panels of the group {group} (Alt+{number})</source><translation>Ansichten der Gruppe {group} (Alt+{number})</translation></message>
<message><source>Paraxial image</source><translation>Paraxiales Bild</translation></message>
<message><source>Paraxial image of this depth, from the last vertex.</source><translation>Paraxiales Bild dieses Abstands, vom letzten Scheitel.</translation></message>
<message><source>Paste a link</source><translation>Link einfügen</translation></message>
<message><source>Peak of the PSF over that of the same pupil with W = 0.</source><translation>Spitze der PSF über der derselben Pupille mit W = 0.</translation></message>
<message><source>Perfect lens</source><translation>Ideale Linse</translation></message>
<message><source>Perfect lens and pixels</source><translation>Ideale Linse und Pixel</translation></message>
<message><source>Periskop-type symmetric lens, f/11, 100 mm</source><translation>Symmetrisches Objektiv vom Periskop-Typ, f/11, 100 mm</translation></message>
<message><source>Petzval lens f/1.4, 50 mm</source><translation>Petzval-Objektiv f/1.4, 50 mm</translation></message>
<message><source>Petzval radius</source><translation>Petzval-Radius</translation></message>
<message><source>Phase</source><translation>Phase</translation></message>
<message><source>Photo…</source><translation>Foto …</translation></message>
<message><source>Picture (*.png);;glTF scene (*.gltf);;OBJ scene (*.obj)</source><translation>Bild (*.png);;glTF-Szene (*.gltf);;OBJ-Szene (*.obj)</translation></message>
<message><source>Picture before and after the lens; arrows move the place looked at, Shift the split</source><translation>Bild vor und hinter dem Objektiv; Pfeile verschieben den betrachteten Ort, mit Umschalt die Teilung</translation></message>
<message><source>Hover or press the arrow keys to look at a place: its PSF and its detail follow. Drag the split, or move it with Shift and the left or right arrow. Drop a PNG or TIFF to photograph it.</source><translation>Mit dem Zeiger oder den Pfeiltasten einen Ort betrachten: seine PSF und sein Ausschnitt folgen. Die Teilung ziehen oder mit Umschalt und Pfeil links oder rechts verschieben. Ein PNG oder TIFF fallen lassen, um es zu fotografieren.</translation></message>
<message><source>Why…</source><translation>Warum …</translation></message>
<message><source>Why the picture is computed in this way: the plan's decisions, each with its error</source><translation>Warum das Bild so berechnet wird: die Entscheidungen des Plans, jede mit ihrem Fehler</translation></message>
<message><source>{file} is no PNG or TIFF; save the photo as one of these and drop that</source><translation>{file} ist weder PNG noch TIFF; das Foto in einem dieser Formate sichern und dieses fallen lassen</translation></message>
<message><source>Picture of one panel</source><translation>Bild einer Ansicht</translation></message>
<message><source>Pin B</source><translation>B merken</translation></message>
<message><source>Pin what is on screen as B, or take B away</source><translation>Das Gezeigte als B merken, oder B entfernen</translation></message>
<message><source>Pin what is on screen as B, to compare with it (Ctrl+B)</source><translation>Das Gezeigte als B merken, um damit zu vergleichen (Strg+B)</translation></message>
<message><source>Pixel</source><translation>Pixel</translation></message>
<message><source>Pixel pitch of the sensor.</source><translation>Pixelabstand des Sensors.</translation></message>
<message><source>Pixel pitch of the sensor; its Nyquist frequency is 1/(2 pitch).</source><translation>Pixelabstand des Sensors; seine Nyquist-Frequenz ist 1/(2 Abstand).</translation></message>
<message><source>Pixels at the field point, or the field</source><translation>Pixel am Feldpunkt, oder das Feld</translation></message>
<message><source>Places</source><translation>Orte</translation></message>
<message><source>Pupils</source><translation>Pupillen</translation></message>
<message><source>Plano-convex singlet, 25.4 mm, N-SF11 (stock lens)</source><translation>Plankonvexe Einzellinse, 25.4 mm, N-SF11 (Lagerware)</translation></message>
<message><source>Play or pause (Space on a slider)</source><translation>Abspielen oder anhalten (Leertaste auf einem Regler)</translation></message>
<message><source>Play or pause the last slider</source><translation>Letzten Regler abspielen oder anhalten</translation></message>
<message><source>Play this slider (Space)</source><translation>Diesen Regler abspielen (Leertaste)</translation></message>
<message><source>Point spread function: the light of one point source on the sensor, |FT{P}|² of the pupil P = A·exp(i2πW).</source><translation>Punktbildfunktion: das Licht einer Punktquelle auf dem Sensor, |FT{P}|² der Pupille P = A·exp(i2πW).</translation></message>
<message><source>Points</source><translation>Punkte</translation></message>
<message><source>Put back</source><translation>Zurück</translation></message>
<message><source>Close the panel's own window and have it back under its tab (Ctrl+D)</source><translation>Das eigene Fenster der Ansicht schließen und sie unter ihrem Reiter wiederhaben (Strg+D)</translation></message>
<message><source>Pop out</source><translation>Lösen</translation></message>
<message><source>Preparing the 3D view: loading it takes some seconds, once.</source><translation>Die 3D-Ansicht wird vorbereitet: das Laden dauert einmal einige Sekunden.</translation></message>
<message><source>Preset</source><translation>Vorgabe</translation></message>
<message><source>Presets</source><translation>Vorgaben</translation></message>
<message><source>Previous step of the lesson</source><translation>Voriger Schritt der Lektion</translation></message>
<message><source>Principal point H</source><translation>Hauptpunkt H</translation></message>
<message><source>Principal point H′</source><translation>Hauptpunkt H′</translation></message>
<message><source>Print</source><translation>Druckseite</translation></message>
<message><source>Profiles</source><translation>Profile</translation></message>
<message><source>Pupil</source><translation>Pupille</translation></message>
<message><source>Pupil phase</source><translation>Pupillenphase</translation></message>
<message><source>Put the sensor where the lens file has it</source><translation>Den Sensor dorthin setzen, wo ihn die Datei hat</translation></message>
<message><source>Put the source at infinity</source><translation>Die Quelle ins Unendliche setzen</translation></message>
<message><source>Put the sweep away</source><translation>Durchlauf wegräumen</translation></message>
<message><source>RMS in x</source><translation>RMS in x</translation></message>
<message><source>RMS in y</source><translation>RMS in y</translation></message>
<message><source>RMS radius</source><translation>RMS-Radius</translation></message>
<message><source>RMS radius {r} µm</source><translation>RMS-Radius {r} µm</translation></message>
<message><source>RMS {r} λ</source><translation>RMS {r} λ</translation></message>
<message><source>RMS {r} λ · PV {p} λ</source><translation>RMS {r} λ · PV {p} λ</translation></message>
<message><source>Radius of curvature, mm: positive when the centre lies to the right; ∞ is a plane.</source><translation>Krümmungsradius, mm: positiv, wenn der Mittelpunkt rechts liegt; ∞ ist eine Ebene.</translation></message>
<message><source>Radius, mm</source><translation>Radius, mm</translation></message>
<message><source>Ray fan</source><translation>Strahlfächer</translation></message>
<message><source>Ray fan: how far an exact ray lands from the chief ray, against its place in the pupil.</source><translation>Strahlfächer: wie weit vom Hauptstrahl ein exakter Strahl landet, über seinem Ort in der Pupille.</translation></message>
<message><source>Rays</source><translation>Strahlen</translation></message>
<message><source>Rear-stop landscape singlet</source><translation>Landschaftslinse mit hinterer Blende</translation></message>
<message><source>Redo</source><translation>Wiederholen</translation></message>
<message><source>Relay of two achromats, stop between, upright pupil (synthetic; finite objects only)</source><translation>Relais aus zwei Achromaten, Blende dazwischen, aufrechte Pupille (synthetisch; nur endliche Objekte)</translation></message>
<message><source>Report (*.pdf)</source><translation>Bericht (*.pdf)</translation></message>
<message><source>Report, command palette, colours, theme, language</source><translation>Bericht, Befehlspalette, Farben, Aussehen, Sprache</translation></message>
<message><source>Report: one page as PDF…</source><translation>Bericht: eine Seite als PDF …</translation></message>
<message><source>Reset</source><translation>Nullen</translation></message>
<message><source>Retrofocus wide angle f/2, 35 mm, 63 degree field</source><translation>Retrofokus-Weitwinkel f/2, 35 mm, 63 Grad Feld</translation></message>
<message><source>Reverse telephoto f/6.7, 60 degree field (f = 2)</source><translation>Umgekehrtes Teleobjektiv f/6.7, 60 Grad Feld (f = 2)</translation></message>
<message><source>Rims clip {lost} of {all} rays, and fitted describes the whole pupil; choose traced or huygens, or leave clip off</source><translation>Ränder nehmen {lost} von {all} Strahlen weg, und fitted beschreibt die ganze Pupille; traced oder huygens wählen oder den Randbeschnitt auslassen</translation></message>
<message><source>R² ≥ 0.9</source><translation>R² ≥ 0.9</translation></message>
<message><source>R² ≥ 0.95</source><translation>R² ≥ 0.95</translation></message>
<message><source>R² ≥ 0.99</source><translation>R² ≥ 0.99</translation></message>
<message><source>R² ≥ 0.999</source><translation>R² ≥ 0.999</translation></message>
<message><source>R² ≥ 0.9999</source><translation>R² ≥ 0.9999</translation></message>
<message><source>Sampling</source><translation>Abtastung</translation></message>
<message><source>Save a film</source><translation>Film speichern</translation></message>
<message><source>Save a snapshot</source><translation>Schnappschuss speichern</translation></message>
<message><source>Save lens as…</source><translation>Objektiv speichern als …</translation></message>
<message><source>Save the 3D view</source><translation>3D-Ansicht speichern</translation></message>
<message><source>Save the PSF, a picture, or the state (Ctrl+E)</source><translation>PSF, Bild oder Zustand speichern (Strg+E)</translation></message>
<message><source>Save the lens</source><translation>Objektiv speichern</translation></message>
<message><source>Save the lens as .toml, .zmx or ISET .json (Ctrl+Shift+S)</source><translation>Das Objektiv als .toml, .zmx oder ISET-.json speichern (Strg+Umschalt+S)</translation></message>
<message><source>Save the lens as it is now…</source><translation>Objektiv speichern, wie es jetzt ist …</translation></message>
<message><source>Save the picture as PNG or TIFF, the state beside it</source><translation>Das Bild als PNG oder TIFF speichern, daneben den Zustand</translation></message>
<message><source>Save the report</source><translation>Bericht speichern</translation></message>
<message><source>Save the sweep as a film…</source><translation>Durchlauf als Film speichern …</translation></message>
<message><source>Save the view as a picture, or the scene as glTF or OBJ</source><translation>Die Ansicht als Bild oder die Szene als glTF oder OBJ speichern</translation></message>
<message><source>Save the way from the first value to the last as a film</source><translation>Den Weg vom ersten bis zum letzten Wert als Film speichern</translation></message>
<message><source>Saved {count} frames, {first} to {last}</source><translation>{count} Bilder gespeichert, {first} bis {last}</translation></message>
<message><source>Saved {name}</source><translation>{name} gespeichert</translation></message>
<message><source>Saved {name}, and its state as {beside}</source><translation>{name} gespeichert, sein Zustand als {beside}</translation></message>
<message><source>Save…</source><translation>Speichern …</translation></message>
<message><source>Seidel contributions: what each surface adds to a coefficient, in waves; large ones of opposite sign cancel.</source><translation>Seidel-Beiträge: was jede Fläche zu einem Koeffizienten beiträgt, in Wellen; große mit entgegengesetztem Vorzeichen heben sich auf.</translation></message>
<message><source>Seidel contributions: what each surface adds to a coefficient, in waves; large ones of opposite sign cancel. Point at a bar: its surface is lit in the layout, and the other way round.</source><translation>Seidel-Beiträge: was jede Fläche zu einem Koeffizienten beiträgt, in Wellen; große mit entgegengesetztem Vorzeichen heben sich auf. Auf einen Balken zeigen: seine Fläche leuchtet im Aufbau, und umgekehrt.</translation></message>
<message><source>Seidel per surface</source><translation>Seidel je Fläche</translation></message>
<message><source>Semi-diameter, mm</source><translation>Halbmesser, mm</translation></message>
<message><source>Sensor</source><translation>Sensor</translation></message>
<message><source>Sensor position</source><translation>Sensorort</translation></message>
<message><source>Sensor shift</source><translation>Sensorversatz</translation></message>
<message><source>Sensor shift Δz away from the lens, on top of focus; it adds defocus Wd = NA²Δz/(2n′λ).</source><translation>Sensorversatz Δz weg vom Objektiv, zusätzlich zur Einstellung; er fügt den Defokus Wd = NA²Δz/(2n′λ) hinzu.</translation></message>
<message><source>Sensor − image</source><translation>Sensor − Bild</translation></message>
<message><source>Shipped lenses</source><translation>Mitgelieferte Objektive</translation></message>
<message><source>Shortcuts</source><translation>Tastenkürzel</translation></message>
<message><source>Shortcuts and terms (F1 or ?)</source><translation>Tastenkürzel und Begriffe (F1 oder ?)</translation></message>
<message><source>Show A − B in PSF, pupil, profiles, MTF and coefficients; the rest shows A</source><translation>A − B in PSF, Pupille, Profilen, MTF und Koeffizienten zeigen; der Rest zeigt A</translation></message>
<message><source>Show A − B; a panel in which a difference means nothing shows A and says why</source><translation>A − B zeigen; eine Ansicht, in der eine Differenz nichts bedeutet, zeigt A und sagt, warum</translation></message>
<message><source>Show A, B, A − B in turn</source><translation>A, B, A − B der Reihe nach zeigen</translation></message>
<message><source>Show A, which the controls move</source><translation>A zeigen, das die Regler bewegen</translation></message>
<message><source>Show B, as it was pinned</source><translation>B zeigen, wie es gemerkt wurde</translation></message>
<message><source>Show the answer</source><translation>Antwort zeigen</translation></message>
<message><source>Show the answer (Alt+Down)</source><translation>Antwort zeigen (Alt+Abwärts)</translation></message>
<message><source>Siemens star</source><translation>Siemensstern</translation></message>
<message><source>Slanted edge</source><translation>Schräge Kante</translation></message>
<message><source>Snapshot</source><translation>Sichern</translation></message>
<message><source>Snapshot: PSF data or picture, with the state…</source><translation>Schnappschuss: PSF-Daten oder Bild, mit Zustand …</translation></message>
<message><source>Solo: only this term counts (S)</source><translation>Solo: nur dieser Term zählt (S)</translation></message>
<message><source>Source depth</source><translation>Quellabstand</translation></message>
<message><source>Spectrum</source><translation>Spektrum</translation></message>
<message><source>Spherical, 1 λ, best focus</source><translation>Sphärisch, 1 λ, bester Fokus</translation></message>
<message><source>Spherical, 1 λ, marginal focus</source><translation>Sphärisch, 1 λ, Randfokus</translation></message>
<message><source>Spherical, 1 λ, paraxial focus</source><translation>Sphärisch, 1 λ, paraxialer Fokus</translation></message>
<message><source>Split what follows this surface by a plane; nothing changes until it is edited (Insert)</source><translation>Was dieser Fläche folgt, durch eine Ebene teilen; es ändert sich nichts, bis sie bearbeitet wird (Einfg)</translation></message>
<message><source>Spot</source><translation>Spot</translation></message>
<message><source>Spot diagram</source><translation>Spotdiagramm</translation></message>
<message><source>Spot diagram: where exact rays, evenly spread over the entrance pupil, meet the sensor; no diffraction.</source><translation>Spotdiagramm: wo exakte Strahlen, gleichmäßig über die Eintrittspupille verteilt, den Sensor treffen; keine Beugung.</translation></message>
<message><source>State only…</source><translation>Nur Zustand …</translation></message>
<message><source>Steps</source><translation>Schritte</translation></message>
<message><source>Stop</source><translation>Blende</translation></message>
<message><source>Stop filming and leave no file</source><translation>Aufnahme abbrechen und keine Datei hinterlassen</translation></message>
<message><source>Stop radius</source><translation>Blendenradius</translation></message>
<message><source>Stop: the surface whose rim limits the light; named by the lens file, or found as the smallest |rim/y|.</source><translation>Blende: die Fläche, deren Rand das Licht begrenzt; in der Datei genannt, oder gefunden als kleinstes |Rand/y|.</translation></message>
<message><source>Strehl</source><translation>Strehl</translation></message>
<message><source>Strehl ratio</source><translation>Strehl-Zahl</translation></message>
<message><source>Strehl {strehl}</source><translation>Strehl {strehl}</translation></message>
<message><source>Surfaces of the lens</source><translation>Flächen des Objektivs</translation></message>
<message><source>Swap</source><translation>Tauschen</translation></message>
<message><source>Sweep</source><translation>Durchlauf</translation></message>
<message><source>Tab, Shift+Tab</source><translation>Tab, Umschalt+Tab</translation></message>
<message><source>Table</source><translation>Tabelle</translation></message>
<message><source>Take B away (Ctrl+B)</source><translation>B entfernen (Strg+B)</translation></message>
<message><source>Take back one step (Ctrl+Z)</source><translation>Einen Schritt zurücknehmen (Strg+Z)</translation></message>
<message><source>Take the step again (Ctrl+Shift+Z)</source><translation>Den Schritt wiederholen (Strg+Umschalt+Z)</translation></message>
<message><source>Take this surface out; the others stay where they are (Delete)</source><translation>Diese Fläche herausnehmen; die anderen bleiben, wo sie sind (Entf)</translation></message>
<message><source>Telephoto f/5.6, 127 mm</source><translation>Teleobjektiv f/5.6, 127 mm</translation></message>
<message><source>Tessar f/4.5 (unit scale, f = 4 in)</source><translation>Tessar f/4.5 (Einheitsmaßstab, f = 4 Zoll)</translation></message>
<message><source>Textbook wavefronts, in a free pupil</source><translation>Wellenfronten aus dem Lehrbuch, in freier Pupille</translation></message>
<message><source>The PSF, the Airy pattern of a perfect lens of this aperture (each over its own peak), and the PSF integrated over square pixels, the middle one centred on the chief ray.</source><translation>Die PSF, das Airy-Muster einer idealen Linse dieser Öffnung (jede über ihrer eigenen Spitze) und die PSF, über quadratische Pixel summiert; das mittlere liegt um den Hauptstrahl.</translation></message>
<message><source>The blur is so large that the picture is ray density, no diffraction; bring focus and source together to see waves.</source><translation>Die Unschärfe ist so groß, dass das Bild die Strahlendichte ohne Beugung ist; Fokus und Quelle zusammenbringen, um Wellen zu sehen.</translation></message>
<message><source>The blur is so large that the picture is ray density, no diffraction; stop down or go nearer the axis to see waves.</source><translation>Die Unschärfe ist so groß, dass das Bild die Strahlendichte ohne Beugung ist; abblenden oder näher an die Achse gehen, um Wellen zu sehen.</translation></message>
<message><source>The chief ray is totally reflected at surface {number}; choose a smaller field</source><translation>Der Hauptstrahl wird an Fläche {number} total reflektiert; ein kleineres Feld wählen</translation></message>
<message><source>The chief ray misses surface {number}; choose a smaller field</source><translation>Der Hauptstrahl verfehlt Fläche {number}; ein kleineres Feld wählen</translation></message>
<message><source>The distance "{text}" has an unknown unit; write mm, cm, m or km, or ∞</source><translation>Der Abstand "{text}" hat eine unbekannte Einheit; mm, cm, m, km oder ∞ schreiben</translation></message>
<message><source>The image of this object lies at ∞ (NA 0), so the sensor holds no PSF; move the object or refocus</source><translation>Das Bild dieses Objekts liegt bei ∞ (NA 0), auf dem Sensor gibt es also keine PSF; das Objekt verschieben oder neu fokussieren</translation></message>
<message><source>The lens differs from its file; save it from the lens table (Ctrl+Shift+S)</source><translation>Das Objektiv weicht von seiner Datei ab; speichern in der Objektivtabelle (Strg+Umschalt+S)</translation></message>
<message><source>The lens to scale: the stop limits the cone of light; its images by the lens are the pupils EnP and ExP.</source><translation>Das Objektiv maßstäblich: die Blende begrenzt den Lichtkegel; ihre Bilder durch das Objektiv sind die Pupillen EnP und ExP.</translation></message>
<message><source>The lens's own: {own}. Added by hand: {added}. Drag the slider to add waves, double-click to take them away; click the number, or press Return, to type it.</source><translation>Vom Objektiv selbst: {own}. Von Hand hinzugefügt: {added}. Ziehen Sie den Regler, um Wellen hinzuzufügen, ein Doppelklick nimmt sie weg; klicken Sie auf die Zahl oder drücken Sie die Eingabetaste, um sie zu tippen.</translation></message>
<message><source>The lens: open the gallery of shipped ones (Ctrl+L); files are under Open (Ctrl+O)</source><translation>Das Objektiv: die Galerie der mitgelieferten öffnen (Strg+L); Dateien sind unter Öffnen (Strg+O)</translation></message>
<message><source>The next step (Alt+Right)</source><translation>Der nächste Schritt (Alt+Rechts)</translation></message>
<message><source>The object lies in the front focal plane, so its image is at infinity; move the source.</source><translation>Das Objekt liegt in der objektseitigen Brennebene, sein Bild also im Unendlichen; die Quelle verschieben.</translation></message>
<message><source>The panel's data are on the clipboard</source><translation>Die Daten der Ansicht sind in der Zwischenablage</translation></message>
<message><source>The panel's picture is on the clipboard</source><translation>Das Bild der Ansicht ist in der Zwischenablage</translation></message>
<message><source>The point's spectrum; or type planck:4300 (kelvin) or lines:486,656 (nm)</source><translation>Das Spektrum des Punktes; oder planck:4300 (Kelvin) oder lines:486,656 (nm) tippen</translation></message>
<message><source>The state's lists are nested too deep; save it again from the explorer</source><translation>Die Listen des Zustands sind zu tief verschachtelt; im Explorer neu speichern</translation></message>
<message><source>The step before (Alt+Left)</source><translation>Der Schritt davor (Alt+Links)</translation></message>
<message><source>The rim of surface {rim} is narrower for this object than the stop on surface {stop}; the stop is kept, choose stop auto to let the narrowest rim decide.</source><translation>Der Rand von Fläche {rim} ist für dieses Objekt enger als die Blende auf Fläche {stop}; die Blende bleibt, die Wahl „gefunden“ lässt den engsten Rand entscheiden.</translation></message>
<message><source>The surface whose rim limits the light.</source><translation>Die Fläche, deren Rand das Licht begrenzt.</translation></message>
<message><source>The wavefront as a surface; drag it or use the arrow keys to turn it</source><translation>Die Wellenfront als Fläche; durch Ziehen oder mit den Pfeiltasten zu drehen</translation></message>
<message><source>The window began with this lesson, so there is nothing to put back: its lens stays</source><translation>Das Fenster begann mit dieser Lektion, also gibt es nichts zurückzuholen: ihr Objektiv bleibt</translation></message>
<message><source>The {what} "{text}" has the unit "{unit}"; write the number alone</source><translation>"{text}" hat die Einheit "{unit}" bei: {what}; nur die Zahl schreiben</translation></message>
<message><source>The {what} "{text}" has the unit "{unit}"; write {known} or no unit</source><translation>"{text}" hat die Einheit "{unit}" bei: {what}; {known} oder keine Einheit schreiben</translation></message>
<message><source>The {what} "{text}" is not a number; write one such as 12.5</source><translation>"{text}" ist keine Zahl für: {what}; eine wie 12.5 schreiben</translation></message>
<message><source>Theme</source><translation>Aussehen</translation></message>
<message><source>Thickness, mm</source><translation>Dicke, mm</translation></message>
<message><source>This set-up cannot be computed; what was here belongs to the one before.</source><translation>Diese Einstellung lässt sich nicht berechnen; was hier war, gehört zur vorigen.</translation></message>
<message><source>This is A: a database belongs to one lens.</source><translation>Dies ist A: eine Datenbank gehört zu einem Objektiv.</translation></message>
<message><source>This is A: a spot is places of rays, not amounts; the fans show A − B.</source><translation>Dies ist A: ein Spot besteht aus Orten von Strahlen, nicht aus Mengen; A − B zeigen die Fächer.</translation></message>
<message><source>This is A: bodies in space have no difference that could be shown.</source><translation>Dies ist A: Körper im Raum haben keine Differenz, die sich zeigen ließe.</translation></message>
<message><source>This is A: each lens is measured against its own rays.</source><translation>Dies ist A: jedes Objektiv wird an seinen eigenen Strahlen gemessen.</translation></message>
<message><source>This is A: here it is compared with a perfect lens.</source><translation>Dies ist A: hier wird es mit einem perfekten Objektiv verglichen.</translation></message>
<message><source>This is A: how far it is sharp is where it begins and ends, which B does not move.</source><translation>Dies ist A: wie weit es scharf ist, sagen Anfang und Ende, und B verschiebt sie nicht.</translation></message>
<message><source>This is A: it has {a} surfaces and B has {b}, so that none stands for another.</source><translation>Dies ist A: es hat {a} Flächen und B hat {b}, sodass keine einer anderen entspricht.</translation></message>
<message><source>This is A: it is the lens that is edited here; the strip above names what differs.</source><translation>Dies ist A: bearbeitet wird hier dieses Objektiv; die Leiste oben nennt, worin sie sich unterscheiden.</translation></message>
<message><source>This is A: it is what was read from its file.</source><translation>Dies ist A: es ist, was aus seiner Datei gelesen wurde.</translation></message>
<message><source>This is A: light that A has less of than B cannot be shown as a photograph.</source><translation>Dies ist A: Licht, von dem A weniger hat als B, lässt sich nicht als Foto zeigen.</translation></message>
<message><source>This is A: one colour less another is no colour.</source><translation>Dies ist A: eine Farbe weniger eine andere ist keine Farbe.</translation></message>
<message><source>This is A: over the field the pictures of A and of B have windows of their own; PSF shows A − B.</source><translation>Dies ist A: über das Feld haben die Bilder von A und von B eigene Fenster; A − B zeigt die PSF.</translation></message>
<message><source>This is A: the diagram's points are surfaces, and those of B are others.</source><translation>Dies ist A: die Punkte des Diagramms sind Flächen, und die von B sind andere.</translation></message>
<message><source>This is A: two lenses drawn to scale have no difference that could be drawn.</source><translation>Dies ist A: zwei maßstäblich gezeichnete Objektive haben keine Differenz, die sich zeichnen ließe.</translation></message>
<message><source>This panel has no numbers</source><translation>Diese Ansicht hat keine Zahlen</translation></message>
<message><source>This panel stands in its own window; close that window to have it back here.</source><translation>Diese Ansicht steht in einem eigenen Fenster; dieses schließen, um es hier wieder zu haben.</translation></message>
<message><source>Through focus</source><translation>Fokusreihe</translation></message>
<message><source>Through focus: the PSF at several sensor positions, brightness over that of the brightest. Drag the line or click: the sensor follows. S, T: where sagittal and tangential rays come to focus; best: smallest RMS wavefront.</source><translation>Fokusreihe: die PSF an mehreren Sensororten, Helligkeit über der hellsten. Die Linie ziehen oder klicken: der Sensor folgt. S, T: wo sagittale und tangentiale Strahlen zum Fokus kommen; best: kleinster RMS der Wellenfront.</translation></message>
<message><source>Tolerance</source><translation>Toleranz</translation></message>
<message><source>Tolerance: the R² against the Huygens reference that auto must promise.</source><translation>Toleranz: das R² gegen die Huygens-Referenz, das auto versprechen muss.</translation></message>
<message><source>Tolerated blur</source><translation>Erlaubte Unschärfe</translation></message>
<message><source>Tools</source><translation>Extras</translation></message>
<message><source>Track</source><translation>Baulänge</translation></message>
<message><source>Try</source><translation>Versuchen</translation></message>
<message><source>Type a few letters, choose with ↑ ↓, Enter does it, Escape goes back.</source><translation>Einige Buchstaben tippen, mit ↑ ↓ wählen, Enter führt aus, Esc geht zurück.</translation></message>
<message><source>Undo</source><translation>Rückgängig</translation></message>
<message><source>Units of the colour bar</source><translation>Einheit der Farbskala</translation></message>
<message><source>Unpin</source><translation>B lösen</translation></message>
<message><source>Viridis</source><translation>Viridis</translation></message>
<message><source>W modulo 1, waves</source><translation>W modulo 1, Wellen</translation></message>
<message><source>W × {front} along the rays</source><translation>W × {front} längs der Strahlen</translation></message>
<message><source>W × {front} along the rays · PSF × {psf} wide, height: {scale} · {wavelength} nm</source><translation>W × {front} längs der Strahlen · PSF × {psf} breit, Höhe: {scale} · {wavelength} nm</translation></message>
<message><source>W, waves</source><translation>W, Wellen</translation></message>
<message><source>W11 added</source><translation>W11 hinzu</translation></message>
<message><source>W11 distortion</source><translation>W11 Verzeichnung</translation></message>
<message><source>W20 added</source><translation>W20 hinzu</translation></message>
<message><source>W20 field curvature</source><translation>W20 Bildfeldwölbung</translation></message>
<message><source>W22 added</source><translation>W22 hinzu</translation></message>
<message><source>W22 astigmatism</source><translation>W22 Astigmatismus</translation></message>
<message><source>W31 added</source><translation>W31 hinzu</translation></message>
<message><source>W31 coma</source><translation>W31 Koma</translation></message>
<message><source>W40 added</source><translation>W40 hinzu</translation></message>
<message><source>W40 spherical aberration</source><translation>W40 sphärische Aberration</translation></message>
<message><source>Wavefront W over the pupil: how far, in waves, a ray's optical path falls short of the chief ray's.</source><translation>Wellenfront W über die Pupille: um wie viele Wellen der optische Weg eines Strahls kürzer als der des Hauptstrahls ist.</translation></message>
<message><source>Wavefront coefficients: the peak value of each term of W(ρ, θ) at this field, in waves.</source><translation>Wellenfrontkoeffizienten: der Höchstwert jedes Glieds von W(ρ, θ) an diesem Feld, in Wellen.</translation></message>
<message><source>Wavelength</source><translation>Wellenlänge</translation></message>
<message><source>Wavelength {w} is outside the data of {glass}, {low} to {high}; ask for a wavelength inside, or change the glass</source><translation>Die Wellenlänge {w} liegt außerhalb der Daten von {glass}, {low} bis {high}; eine Wellenlänge darin wählen oder das Glas wechseln</translation></message>
<message><source>Wavelength λ in vacuum; the index of each glass n(λ) follows it. F, d and C are Fraunhofer's lines.</source><translation>Wellenlänge λ im Vakuum; der Brechungsindex n(λ) jedes Glases folgt ihr. F, d und C sind Fraunhofers Linien.</translation></message>
<message><source>Wd = 0: a line towards the field</source><translation>Wd = 0: eine Linie zum Feld hin</translation></message>
<message><source>Wd = −2 W40: rim rays meet on the axis</source><translation>Wd = −2 W40: Randstrahlen treffen sich auf der Achse</translation></message>
<message><source>Wd = −W22/2: a cross</source><translation>Wd = −W22/2: ein Kreuz</translation></message>
<message><source>Wd = −W22: a line across the field</source><translation>Wd = −W22: eine Linie quer zum Feld</translation></message>
<message><source>Wd = −W40 leaves a sixteenth of the variance</source><translation>Wd = −W40 lässt ein Sechzehntel der Varianz</translation></message>
<message><source>Wd added</source><translation>Wd hinzu</translation></message>
<message><source>Wd defocus</source><translation>Wd Defokus</translation></message>
<message><source>Wd is muted, so moving the sensor does not focus; set Wd by its slider, or reset the what-if</source><translation>Wd ist stumm, also stellt ein anderer Ort des Sensors nicht scharf; Wd am Regler einstellen oder das Was-wäre-wenn zurücksetzen</translation></message>
<message><source>What do you want to do?</source><translation>Was soll geschehen?</translation></message>
<message><source>What follows the surface: a name such as "SCHOTT N-BK7", an index, or "nd 1.5168 vd 64.17".</source><translation>Was der Fläche folgt: ein Name wie "SCHOTT N-BK7", ein Index oder "nd 1.5168 vd 64.17".</translation></message>
<message><source>What is pinned as B must be one state with nothing pinned in it; pin it again</source><translation>Was als B gemerkt ist, muss ein einzelner Zustand sein, in dem nichts gemerkt ist; neu merken</translation></message>
<message><source>What moves A and B together</source><translation>Was A und B gemeinsam bewegt</translation></message>
<message><source>What stands before the lens</source><translation>Was vor dem Objektiv steht</translation></message>
<message><source>What the film shows</source><translation>Was der Film zeigt</translation></message>
<message><source>What-if: coefficients altered by hand; image, database, field curves, chromatic shift, depth of field, rays, spots, fans and sums per surface stay the lens's own.</source><translation>Was wäre wenn: Koeffizienten von Hand geändert; Bild, Datenbank, Feldkurven, Farbverschiebung, Schärfentiefe, Strahlen, Spots, Fächer und Summen je Fläche bleiben die des Objektivs.</translation></message>
<message><source>What-if: waves added to the six coefficients</source><translation>Was wäre wenn: Wellen, zu den sechs Koeffizienten hinzugefügt</translation></message>
<message><source>Unmeasured. When the sliders rest a plan follows.</source><translation>Ungemessen. Wenn die Regler ruhen, folgt ein Plan.</translation></message>
<message><source>Unmeasured. No plan is made for pixels as large as these, which hide what it cares for: choose smaller ones.</source><translation>Ungemessen. Für so große Pixel wird kein Plan gemacht, denn sie verbergen, worum es ihm geht: kleinere wählen.</translation></message>
<message><source>Unmeasured. No plan is made for PSFs as wide as these: it would take minutes.</source><translation>Ungemessen. Für so breite PSFs wird kein Plan gemacht: er würde Minuten brauchen.</translation></message>
<message><source>No plan: these pixels hide the PSF</source><translation>Kein Plan: so große Pixel verbergen die PSF</translation></message>
<message><source>No plan: these PSFs are too wide</source><translation>Kein Plan: diese PSFs sind zu breit</translation></message>
<message><source>{choice}: {why} (error {error})</source><translation>{choice}: {why} (Fehler {error})</translation></message>
<message><source>{error} relative, keeps {tolerance}; the full grid takes {count} times as long</source><translation>{error} relativ, hält {tolerance} ein; das volle Gitter dauert {count}-mal so lang</translation></message>
<message><source>{error} relative, does not keep {tolerance}; the full grid takes {count} times as long</source><translation>{error} relativ, hält {tolerance} nicht ein; das volle Gitter dauert {count}-mal so lang</translation></message>
<message><source>the scene has one depth</source><translation>die Szene hat nur einen Abstand</translation></message>
<message><source>1 node</source><translation>1 Knoten</translation></message>
<message><source>{count} nodes</source><translation>{count} Knoten</translation></message>
<message><source>{rows} × {columns} nodes</source><translation>{rows} × {columns} Knoten</translation></message>
<message><source>Points {depth} away blur over {wide}, which takes {side}² samples of {most}² at most; bring the depths nearer to the focus or stop down</source><translation>Punkte in {depth} verschwimmen über {wide}, das braucht {side}² Abtastwerte von höchstens {most}²; die Abstände näher an den Fokus bringen oder abblenden</translation></message>
<message><source>{count} fits</source><translation>{count} Anpassungen</translation></message>
<message><source>fewer of the dearest method with the others in between would cost no less</source><translation>weniger davon auf der teuersten Stufe mit den übrigen dazwischen kosteten nicht weniger</translation></message>
<message><source>heights × depths in each wavelength: {heights} × {depths}; the others of {count} lie on polynomials through them</source><translation>Höhen × Abstände je Wellenlänge: {heights} × {depths}; die übrigen von {count} liegen auf Polynomen durch diese</translation></message>
<message><source>kernels in the middle of a cell are then the mean of its corners</source><translation>Kerne mitten in einer Zelle sind dann das Mittel ihrer Ecken</translation></message>
<message><source>defocus grows with 1/distance, so nodes stand at equal steps of it</source><translation>die Defokussierung wächst mit 1/Abstand, daher stehen die Knoten in gleichen Schritten davon</translation></message>
<message><source>at the corner {count} phase terms stay below {waves} waves RMS together, the strongest (n={n}, m={m}) has {most} waves</source><translation>in der Ecke bleiben {count} Phasenterme zusammen unter {waves} Wellen RMS, der stärkste (n={n}, m={m}) hat {most} Wellen</translation></message>
<message><source>at the corner {count} phase terms stay below {waves} waves RMS together</source><translation>in der Ecke bleiben {count} Phasenterme zusammen unter {waves} Wellen RMS</translation></message>
<message><source>{count} kept</source><translation>{count} behalten</translation></message>
<message><source>{numbers} fitted numbers are the fewest that keep it; the next cheaper method does not</source><translation>{numbers} angepasste Zahlen sind die wenigsten, die das einhalten; die nächstbilligere Stufe tut es nicht</translation></message>
<message><source>{count} of {all} wavelengths keep the channel's lateral and axial colour</source><translation>{count} von {all} Wellenlängen erhalten Farbquer- und Farblängsfehler des Kanals</translation></message>
<message><source>pixels of {pixel} µm average finer fringes; the window has a margin of {margin}</source><translation>Pixel von {pixel} µm mitteln feinere Streifen; das Fenster hat einen Rand von {margin}</translation></message>
<message><source>PSF, √</source><translation>PSF, √</translation></message>
<message><source>the six Seidel coefficients keep the pixels' error here</source><translation>die sechs Seidel-Koeffizienten halten hier den Fehler der Pixel ein</translation></message>
<message><source>When the sliders rest, the picture is compared with a converged sum of exact rays (Huygens): the reference, the difference, and what every method costs in time and error appear here.</source><translation>Wenn die Regler ruhen, wird das Bild mit einer auskonvergierten Summe exakter Strahlen (Huygens) verglichen: Referenz, Unterschied und was jede Methode an Zeit und Fehler kostet, erscheinen hier.</translation></message>
<message><source>Where the sensor stands, from the last vertex.</source><translation>Wo der Sensor steht, vom letzten Scheitel.</translation></message>
<message><source>Which coefficient</source><translation>Welcher Koeffizient</translation></message>
<message><source>Which interpolation the error is of</source><translation>Zu welcher Interpolation der Fehler gehört</translation></message>
<message><source>Which picture is made</source><translation>Welches Bild gemacht wird</translation></message>
<message><source>Which slider moves</source><translation>Welcher Regler sich bewegt</translation></message>
<message><source>Window</source><translation>Fenster</translation></message>
<message><source>Working f-number</source><translation>Wirksame Blendenzahl</translation></message>
<message><source>Working f-number 1/(2 NA) at this depth.</source><translation>Wirksame Blendenzahl 1/(2 NA) bei diesem Abstand.</translation></message>
<message><source>a dark centre: Wd of a whole wave cancels on the axis</source><translation>eine dunkle Mitte: Wd von einer ganzen Welle löscht auf der Achse aus</translation></message>
<message><source>a sharp core in a wide halo</source><translation>ein scharfer Kern in weitem Hof</translation></message>
<message><source>air</source><translation>Luft</translation></message>
<message><source>all panels</source><translation>alle Ansichten</translation></message>
<message><source>all, stacked</source><translation>alle, gestapelt</translation></message>
<message><source>along x</source><translation>längs x</translation></message>
<message><source>along y</source><translation>längs y</translation></message>
<message><source>as in the file</source><translation>laut Datei</translation></message>
<message><source>astigmatism</source><translation>Astigmatismus</translation></message>
<message><source>at infinity</source><translation>im Unendlichen</translation></message>
<message><source>at {wavelength} nm</source><translation>bei {wavelength} nm</translation></message>
<message><source>auto</source><translation>auto</translation></message>
<message><source>back to the lens's own value</source><translation>zurück zum Wert des Objektivs</translation></message>
<message><source>best {shift} µm</source><translation>best {shift} µm</translation></message>
<message><source>black body 5600 K</source><translation>Schwarzer Körper 5600 K</translation></message>
<message><source>blur, µm</source><translation>Unschärfe, µm</translation></message>
<message><source>brightness</source><translation>Helligkeit</translation></message>
<message><source>by hand</source><translation>von Hand</translation></message>
<message><source>by the axis's PSF</source><translation>mit der PSF der Achse</translation></message>
<message><source>centroid y {y} µm</source><translation>Schwerpunkt y {y} µm</translation></message>
<message><source>chief ray</source><translation>Hauptstrahl</translation></message>
<message><source>chief ray ȳ, mm</source><translation>Hauptstrahl ȳ, mm</translation></message>
<message><source>chief ray, µm</source><translation>Hauptstrahl, µm</translation></message>
<message><source>circle: Airy {r} µm</source><translation>Kreis: Airy {r} µm</translation></message>
<message><source>coarse</source><translation>grob</translation></message>
<message><source>coma</source><translation>Koma</translation></message>
<message><source>contour</source><translation>Höhenlinien</translation></message>
<message><source>contours</source><translation>Höhenlinien</translation></message>
<message><source>contrast</source><translation>Kontrast</translation></message>
<message><source>corner {field}</source><translation>Ecke {field}</translation></message>
<message><source>cycles per mm on the sensor</source><translation>Perioden je mm auf dem Sensor</translation></message>
<message><source>daylight D65</source><translation>Tageslicht D65</translation></message>
<message><source>defocus</source><translation>Defokus</translation></message>
<message><source>decimal separator</source><translation>,</translation></message>
<message><source>depth, even in 1/depth</source><translation>Abstand, gleichmäßig in 1/Abstand</translation></message>
<message><source>difference, share of the reference's peak</source><translation>Differenz, Anteil der Spitze der Referenz</translation></message>
<message><source>distance from the chief ray, µm</source><translation>Entfernung vom Hauptstrahl, µm</translation></message>
<message><source>distortion</source><translation>Verzeichnung</translation></message>
<message><source>distortion, %</source><translation>Verzeichnung, %</translation></message>
<message><source>double-click</source><translation>Doppelklick</translation></message>
<message><source>drop a file</source><translation>Datei fallen lassen</translation></message>
<message><source>earlier picture</source><translation>früheres Bild</translation></message>
<message><source>earlier picture, working</source><translation>früheres Bild, in Arbeit</translation></message>
<message><source>edited</source><translation>bearbeitet</translation></message>
<message><source>energy within</source><translation>Energie innerhalb</translation></message>
<message><source>equal energy</source><translation>gleiche Energie</translation></message>
<message><source>error of table 1 of the paper</source><translation>Fehler von Tabelle 1 des Aufsatzes</translation></message>
<message><source>exact rays</source><translation>exakte Strahlen</translation></message>
<message><source>exact rays, this field</source><translation>exakt, dieses Feld</translation></message>
<message><source>f-number</source><translation>Blendenzahl</translation></message>
<message><source>f-number N = f′/D: focal length over the diameter of the entrance pupil.</source><translation>Blendenzahl N = f′/D: Brennweite durch den Durchmesser der Eintrittspupille.</translation></message>
<message><source>field angle</source><translation>Feldwinkel</translation></message>
<message><source>field curv.</source><translation>Bildwölbung</translation></message>
<message><source>field curvature</source><translation>Bildfeldwölbung</translation></message>
<message><source>field, °</source><translation>Feld, °</translation></message>
<message><source>file</source><translation>Datei</translation></message>
<message><source>fitted</source><translation>fitted</translation></message>
<message><source>fitted: polynomial from real rays</source><translation>fitted: Polynom aus wahren Strahlen</translation></message>
<message><source>fitted: {numbers} numbers from {rays} rays, predicted R² ≥ {r}; the six Seidel coefficients would miss {goal}</source><translation>fitted: {numbers} Zahlen aus {rays} Strahlen, vorhergesagt R² ≥ {r}; die sechs Seidel-Koeffizienten verfehlten {goal}</translation></message>
<message><source>focus behind the sensor, mm</source><translation>Fokus hinter dem Sensor, mm</translation></message>
<message><source>focus, µm</source><translation>Fokus, µm</translation></message>
<message><source>found</source><translation>gefunden</translation></message>
<message><source>free pupil</source><translation>freie Pupille</translation></message>
<message><source>from</source><translation>von</translation></message>
<message><source>geometric: ray density, no diffraction</source><translation>geometrisch: Strahlendichte, keine Beugung</translation></message>
<message><source>geometric: ray density, no diffraction; {share} % of the pupil's light is in view</source><translation>geometrisch: Strahlendichte, keine Beugung; {share} % des Lichts der Pupille im Bild</translation></message>
<message><source>huygens</source><translation>huygens</translation></message>
<message><source>huygens: the reference sum</source><translation>huygens: die Referenzsumme</translation></message>
<message><source>hyperfocal distance {focus}</source><translation>hyperfokal {focus}</translation></message>
<message><source>image</source><translation>Bild</translation></message>
<message><source>image height {h} mm</source><translation>Bildhöhe {h} mm</translation></message>
<message><source>image {h} mm</source><translation>Bild {h} mm</translation></message>
<message><source>in</source><translation>in</translation></message>
<message><source>infinity</source><translation>unendlich</translation></message>
<message><source>landing point, µm</source><translation>Landepunkt, µm</translation></message>
<message><source>largest error in {name}: exact {error} λ</source><translation>größter Fehler in {name}: exakt {error} λ</translation></message>
<message><source>lateral colour {shift} µm</source><translation>Farbquerfehler {shift} µm</translation></message>
<message><source>linear</source><translation>linear</translation></message>
<message><source>linear brightness</source><translation>lineare Helligkeit</translation></message>
<message><source>linear {error} λ, on {depths} depths × {fields} fields × {waves} wavelengths</source><translation>linear {error} λ, auf {depths} Abständen × {fields} Feldern × {waves} Wellenlängen</translation></message>
<message><source>lines F d C</source><translation>Linien F d C</translation></message>
<message><source>log</source><translation>log</translation></message>
<message><source>logarithm of brightness</source><translation>Logarithmus der Helligkeit</translation></message>
<message><source>marginal ray y, mm</source><translation>Randstrahl y, mm</translation></message>
<message><source>marginal rays, axial point</source><translation>Randstrahlen, Achspunkt</translation></message>
<message><source>mercury g e</source><translation>Quecksilber g e</translation></message>
<message><source>move the slider that has the focus</source><translation>den Regler bewegen, der den Fokus hat</translation></message>
<message><source>off</source><translation>aus</translation></message>
<message><source>on</source><translation>an</translation></message>
<message><source>the free pupil has no lens, so moving the sensor does not focus; set Wd by its slider, or reset the what-if</source><translation>die freie Pupille hat kein Objektiv, also stellt ein anderer Ort des Sensors nicht scharf; Wd am Regler einstellen oder das Was-wäre-wenn zurücksetzen</translation></message>
<message><source>the lens itself</source><translation>ganz vorn am Objektiv</translation></message>
<message><source>no depth before the lens is sharp</source><translation>kein Abstand vor dem Objektiv ist scharf</translation></message>
<message><source>object at infinity</source><translation>Objekt im Unendlichen</translation></message>
<message><source>object at {depth}</source><translation>Objekt bei {depth}</translation></message>
<message><source>object {h} mm</source><translation>Objekt {h} mm</translation></message>
<message><source>of light</source><translation>des Lichts</translation></message>
<message><source>of peak</source><translation>der Spitze</translation></message>
<message><source>on the pixels, µm</source><translation>auf den Pixeln, µm</translation></message>
<message><source>one-sided rings and a moved peak</source><translation>einseitige Ringe und eine verschobene Spitze</translation></message>
<message><source>open it: Zemax .zmx (also zipped), CODE V .seq, ISET .json and .dat, Optical Bench .txt, .csv with named columns, .toml, or a saved state</source><translation>öffnet sie: Zemax .zmx (auch gezippt), CODE V .seq, ISET .json und .dat, Optical Bench .txt, .csv mit benannten Spalten, .toml oder ein gespeicherter Zustand</translation></message>
<message><source>paraxial</source><translation>paraxial</translation></message>
<message><source>paraxial, axis</source><translation>paraxial, Achse</translation></message>
<message><source>peak</source><translation>Spitze</translation></message>
<message><source>peak = 1</source><translation>Spitze = 1</translation></message>
<message><source>per pixel</source><translation>je Pixel</translation></message>
<message><source>perfect lens</source><translation>ideale Linse</translation></message>
<message><source>perfect lens, µm</source><translation>ideale Linse, µm</translation></message>
<message><source>picture − reference, µm</source><translation>Bild − Referenz, µm</translation></message>
<message><source>pictures {wide} µm wide</source><translation>Bilder {wide} µm breit</translation></message>
<message><source>pictures {wide} µm wide, each over its own peak</source><translation>Bilder {wide} µm breit, jedes über seiner Spitze</translation></message>
<message><source>place in the entrance pupil, pupil radii</source><translation>Ort in der Eintrittspupille, Pupillenradien</translation></message>
<message><source>planned</source><translation>geplant</translation></message>
<message><source>planning</source><translation>Plan</translation></message>
<message><source>present field</source><translation>jetziges Feld</translation></message>
<message><source>preview {fast} / settled {ms} ms</source><translation>Vorschau {fast} / fertig {ms} ms</translation></message>
<message><source>preview {ms} ms</source><translation>Vorschau {ms} ms</translation></message>
<message><source>radius, µm</source><translation>Radius, µm</translation></message>
<message><source>ray density</source><translation>Strahlendichte</translation></message>
<message><source>reference, µm</source><translation>Referenz, µm</translation></message>
<message><source>relative L2 error</source><translation>relativer L2-Fehler</translation></message>
<message><source>rim</source><translation>Rand</translation></message>
<message><source>rim rays of the field point</source><translation>Randstrahlen des Feldpunkts</translation></message>
<message><source>root of brightness</source><translation>Wurzel der Helligkeit</translation></message>
<message><source>sagittal</source><translation>sagittal</translation></message>
<message><source>sagittal S</source><translation>sagittal S</translation></message>
<message><source>sagittal, along ξ</source><translation>sagittal, längs ξ</translation></message>
<message><source>scene</source><translation>Szene</translation></message>
<message><source>seconds one way</source><translation>Sekunden je Weg</translation></message>
<message><source>seidel</source><translation>seidel</translation></message>
<message><source>seidel from the six coefficients (what-if: coefficients altered by hand)</source><translation>seidel aus den sechs Koeffizienten (Was wäre wenn: von Hand geändert)</translation></message>
<message><source>seidel: six coefficients</source><translation>seidel: sechs Koeffizienten</translation></message>
<message><source>seidel: six coefficients, predicted R² ≥ {r}</source><translation>seidel: sechs Koeffizienten, vorhergesagt R² ≥ {r}</translation></message>
<message><source>sensor</source><translation>Sensor</translation></message>
<message><source>sensor shift</source><translation>Sensorversatz</translation></message>
<message><source>sensor shift, µm</source><translation>Sensorversatz, µm</translation></message>
<message><source>settled {ms} ms</source><translation>fertig {ms} ms</translation></message>
<message><source>share of the light in a pixel</source><translation>Anteil des Lichts in einem Pixel</translation></message>
<message><source>share of the peak</source><translation>Anteil an der Spitze</translation></message>
<message><source>sharp from {near} to {far}</source><translation>scharf von {near} bis {far}</translation></message>
<message><source>sharp from {near} to {far} · hyperfocal distance {focus}</source><translation>scharf von {near} bis {far} · hyperfokal {focus}</translation></message>
<message><source>sharpened by its PSFs</source><translation>mit seinen PSFs geschärft</translation></message>
<message><source>six coefficients</source><translation>sechs Koeffizienten</translation></message>
<message><source>spherical</source><translation>sphärisch</translation></message>
<message><source>spherical aberration</source><translation>sphärische Aberration</translation></message>
<message><source>square root</source><translation>Wurzel</translation></message>
<message><source>square root of brightness</source><translation>Wurzel der Helligkeit</translation></message>
<message><source>step {k} of {n}</source><translation>Schritt {k} von {n}</translation></message>
<message><source>stop</source><translation>Blende</translation></message>
<message><source>stop ▪</source><translation>Blende ▪</translation></message>
<message><source>stop, sensor</source><translation>Blende, Sensor</translation></message>
<message><source>sum</source><translation>Summe</translation></message>
<message><source>sum = 1</source><translation>Summe = 1</translation></message>
<message><source>sum {sum} λ</source><translation>Summe {sum} λ</translation></message>
<message><source>sum {waves} λ</source><translation>Summe {waves} λ</translation></message>
<message><source>summing the reference: {part} %</source><translation>die Referenz wird summiert: {part} %</translation></message>
<message><source>surface</source><translation>Fläche</translation></message>
<message><source>surface {number} (auto)</source><translation>Fläche {number} (gefunden)</translation></message>
<message><source>surface {number} (file)</source><translation>Fläche {number} (Datei)</translation></message>
<message><source>table 1 of the paper</source><translation>Tabelle 1 des Aufsatzes</translation></message>
<message><source>table1 {error} λ</source><translation>Tabelle 1 {error} λ</translation></message>
<message><source>tangential</source><translation>tangential</translation></message>
<message><source>tangential T</source><translation>tangential T</translation></message>
<message><source>tangential, along η</source><translation>tangential, längs η</translation></message>
<message><source>the Airy pattern</source><translation>die Airy-Figur</translation></message>
<message><source>the PSF</source><translation>die PSF</translation></message>
<message><source>the coefficients</source><translation>die Koeffizienten</translation></message>
<message><source>the comet: rays fill a cone of 60°</source><translation>der Komet: Strahlen füllen einen Kegel von 60°</translation></message>
<message><source>the layout</source><translation>der Aufbau</translation></message>
<message><source>the lens's own</source><translation>die des Objektivs</translation></message>
<message><source>the middle pixel holds {real} % of the light, of a perfect lens's {perfect} %</source><translation>das mittlere Pixel hält {real} % des Lichts, von dem einer idealen Linse {perfect} %</translation></message>
<message><source>the open tab</source><translation>das offene Blatt</translation></message>
<message><source>the pupil</source><translation>die Pupille</translation></message>
<message><source>the reference is summed when the sliders rest</source><translation>die Referenz wird summiert, wenn die Regler ruhen</translation></message>
<message><source>there is no link to paste; copy one that begins with p2sf:</source><translation>kein Link zum Einfügen da; einen kopieren, der mit p2sf: beginnt</translation></message>
<message><source>this lens, µm</source><translation>diese Linse, µm</translation></message>
<message><source>through the lens</source><translation>durch das Objektiv</translation></message>
<message><source>time of one PSF, ms</source><translation>Zeit einer PSF, ms</translation></message>
<message><source>to</source><translation>bis</translation></message>
<message><source>to the next or the previous control</source><translation>zum nächsten oder vorigen Bedienteil</translation></message>
<message><source>traced</source><translation>traced</translation></message>
<message><source>traced: exact rays, predicted R² ≥ {r}; {lost} of {all} rays are lost, and a smooth pupil does not describe that</source><translation>traced: exakte Strahlen, vorhergesagt R² ≥ {r}; {lost} von {all} Strahlen gehen verloren, und das beschreibt keine glatte Pupille</translation></message>
<message><source>traced: exact wavefront</source><translation>traced: exakte Wellenfront</translation></message>
<message><source>tungsten 2856 K</source><translation>Glühlampe 2856 K</translation></message>
<message><source>typed</source><translation>getippt</translation></message>
<message><source>wavelength</source><translation>Wellenlänge</translation></message>
<message><source>wavelength, nm</source><translation>Wellenlänge, nm</translation></message>
<message><source>waves</source><translation>Wellen</translation></message>
<message><source>waves at {wavelength} nm</source><translation>Wellen bei {wavelength} nm</translation></message>
<message><source>what no single term shows</source><translation>was kein einzelnes Glied zeigt</translation></message>
<message><source>what-if</source><translation>Was wäre wenn</translation></message>
<message><source>what-if: altered by hand</source><translation>von Hand geändert</translation></message>
<message><source>what-if: coefficients altered by hand</source><translation>Was wäre wenn: Koeffizienten von Hand geändert</translation></message>
<message><source>what-if: coefficients altered by hand, so the lens's Huygens reference does not apply; reset them to measure again</source><translation>Was wäre wenn: Koeffizienten von Hand geändert, daher gilt die Huygens-Referenz des Objektivs nicht; setzen Sie sie zurück, um wieder zu messen</translation></message>
<message><source>whole field</source><translation>ganzes Feld</translation></message>
<message><source>working</source><translation>in Arbeit</translation></message>
<message><source>wrapped</source><translation>gefaltet</translation></message>
<message><source>x, µm</source><translation>x, µm</translation></message>
<message><source>x, µm from the chief ray</source><translation>x, µm vom Hauptstrahl</translation></message>
<message><source>y, µm</source><translation>y, µm</translation></message>
<message><source>y, µm (towards the axis)</source><translation>y, µm (zur Achse hin)</translation></message>
<message><source>y, µm (towards the field)</source><translation>y, µm (zum Feld hin)</translation></message>
<message><source>y–ȳ</source><translation>y–ȳ</translation></message>
<message><source>y–ȳ diagram</source><translation>y–ȳ-Diagramm</translation></message>
<message><source>y–ȳ diagram (Delano 1963): marginal ray height against chief ray height at every surface. Where the line crosses ȳ = 0 is the stop or a pupil, where it crosses y = 0 an image.</source><translation>y–ȳ-Diagramm (Delano 1963): Randstrahlhöhe über Hauptstrahlhöhe an jeder Fläche. Wo die Linie ȳ = 0 schneidet, ist die Blende oder eine Pupille, wo sie y = 0 schneidet, ein Bild.</translation></message>
<message><source>{columns} × {rows} pixels of {pitch} µm</source><translation>{columns} × {rows} Pixel zu {pitch} µm</translation></message>
<message><source>This is A: B has none. {why}</source><translation>Dies ist A: B hat keines. {why}</translation></message>
<message><source>Numbers have a decimal point, in every language, as in files and on the command line; a comma that is typed is read as one too.</source><translation>Zahlen haben in jeder Sprache einen Dezimalpunkt, wie in Dateien und auf der Kommandozeile; ein getipptes Komma wird ebenso gelesen.</translation></message>
<message><source>Map over depth and field</source><translation>Karte über Abstand und Feld</translation></message>
<message><source>no picture</source><translation>kein Bild</translation></message>
<message><source>PSFs</source><translation>PSFs</translation></message>
<message><source>{count} PSFs</source><translation>{count} PSFs</translation></message>
<message><source>{rows} × {columns} places × {waves} wavelengths, mirror images for nothing</source><translation>{rows} × {columns} Orte × {waves} Wellenlängen, Spiegelbilder umsonst</translation></message>
<message><source>{rows} × {columns} places × {waves} wavelengths</source><translation>{rows} × {columns} Orte × {waves} Wellenlängen</translation></message>
<message><source>Plan it after all</source><translation>Doch noch planen</translation></message>
<message><source>Make no plan; the coarse picture stays</source><translation>Nicht planen; das grobe Bild bleibt</translation></message>
<message><source>Make the plan that was cancelled, and the picture by it</source><translation>Den abgebrochenen Plan doch machen und das Bild danach</translation></message>
<message><source>top and bottom of the photo cut off</source><translation>Foto oben und unten abgeschnitten</translation></message>
<message><source>sides of the photo cut off</source><translation>Foto seitlich abgeschnitten</translation></message>
<message><source>Frame</source><translation>Ausschnitt</translation></message>
<message><source>The sensor has {columns} × {rows} pixels and the photo other proportions, so that it fills the frame and its sides are cut off, {share} % of its width.</source><translation>Der Sensor hat {columns} × {rows} Pixel und das Foto ein anderes Seitenverhältnis, daher füllt es den Rahmen und ist seitlich abgeschnitten, {share} % seiner Breite.</translation></message>
<message><source>The sensor has {columns} × {rows} pixels and the photo other proportions, so that it fills the frame and its top and bottom are cut off, {share} % of its height.</source><translation>Der Sensor hat {columns} × {rows} Pixel und das Foto ein anderes Seitenverhältnis, daher füllt es den Rahmen und ist oben und unten abgeschnitten, {share} % seiner Höhe.</translation></message>
<message><source>{count} of the drawn rays cannot pass (surface missed, or total reflection); less light arrives than the picture assumes.</source><translation>{count} der gezeichneten Strahlen kommen nicht durch (Fläche verfehlt oder totale Reflexion); es kommt weniger Licht an, als das Bild annimmt.</translation></message>
<message><source>{count} surfaces</source><translation>{count} Flächen</translation></message>
<message><source>{count} surfaces · edited</source><translation>{count} Flächen · bearbeitet</translation></message>
<message><source>{count} wavelengths</source><translation>{count} Wellenlängen</translation></message>
<message><source>{depth}, field {field}°, {wavelength} nm</source><translation>{depth}, Feld {field}°, {wavelength} nm</translation></message>
<message><source>{ms} ms computing</source><translation>{ms} ms Rechnen</translation></message>
<message><source>{ms} ms/frame</source><translation>{ms} ms/Bild</translation></message>
<message><source>{numbers} numbers, {rays} rays; sampling: {words}</source><translation>{numbers} Zahlen, {rays} Strahlen; Abtastung: {words}</translation></message>
<message><source>{number} stop</source><translation>{number} Blende</translation></message>
<message><source>{path} is nested too deep or holds too long a number; save it again</source><translation>{path} ist zu tief verschachtelt oder enthält eine zu lange Zahl; neu speichern</translation></message>
<message><source>{path}, line {number}: the file holds no lens surface between object and image</source><translation>{path}, Zeile {number}: die Datei enthält keine Linsenfläche zwischen Objekt und Bild</translation></message>
<message><source>{path}: there is no such file; check the path</source><translation>{path}: eine solche Datei gibt es nicht; den Pfad prüfen</translation></message>
<message><source>{rows} × {columns} Gauss–Chebyshev × Gauss–Legendre nodes, float32</source><translation>{rows} × {columns} Gauß–Tschebyschow- × Gauß–Legendre-Knoten, float32</translation></message>
<message><source>{rows} × {columns} Gauss–Chebyshev × Gauss–Legendre nodes, float64</source><translation>{rows} × {columns} Gauß–Tschebyschow- × Gauß–Legendre-Knoten, float64</translation></message>
<message><source>{step}: pixels of {pitch} µm average finer fringes; the window has a margin of {margin} (error {error})</source><translation>{step}: Pixel zu {pitch} µm mitteln feinere Streifen; das Fenster hat einen Rand von {margin} (Fehler {error})</translation></message>
<message><source>{what} is {value}; give a number from {low} to {high}</source><translation>{what} ist {value}; eine Zahl von {low} bis {high} angeben</translation></message>
<message><source>±{half} µm depth of focus</source><translation>±{half} µm Fokustiefe</translation></message>
<message><source>η, towards the field</source><translation>η, zum Feld hin</translation></message>
<message><source>λ</source><translation>λ</translation></message>
<message><source>ξ, pupil radii</source><translation>ξ, Pupillenradien</translation></message>
<message><source>← → ↑ ↓, Page Up/Down</source><translation>← → ↑ ↓, Bild auf/ab</translation></message>
<message><source>∞</source><translation>∞</translation></message>
<message><source>⌀ {d} at {z} mm</source><translation>⌀ {d} bei {z} mm</translation></message>
<message><source>▶</source><translation>▶</translation></message>
<message><source>▾ best</source><translation>▾ best</translation></message>
<message><source>This lesson has not been translated and stands here as it was written</source><translation>Diese Lektion ist nicht übersetzt und steht hier, wie sie geschrieben wurde</translation></message>
<message><source>The figures below and the sentence above are those of A, which the controls move.</source><translation>Die Zahlen darunter und der Satz darüber gehören zu A, das die Regler bewegen.</translation></message>
<message><source>the blur is too large for a reference here; bring focus and source together to see waves</source><translation>die Unschärfe ist hier zu groß für eine Referenz; Fokus und Quelle zusammenbringen, um Wellen zu sehen</translation></message>
<message><source>the blur is too large for a reference here; stop down or go nearer the axis to see waves</source><translation>die Unschärfe ist hier zu groß für eine Referenz; abblenden oder näher an die Achse gehen, um Wellen zu sehen</translation></message>
<message><source>{method} follows: its sum of waves takes a moment</source><translation>{method} folgt: die Summe der Wellen dauert einen Augenblick</translation></message>
<message><source>fitted while the slider moves, {method} when it rests</source><translation>fitted, solange der Regler sich bewegt, {method}, wenn er ruht</translation></message>
<message><source>{method} vs Huygens: R² {r} in {wide} µm</source><translation>{method} gegen Huygens: R² {r} in {wide} µm</translation></message>
<message><source>reference from {count} rays, {seconds} s</source><translation>Referenz aus {count} Strahlen, {seconds} s</translation></message>
<message><source>Surface {number} has a clear semi-diameter of {rim} mm, but its radius of {radius} mm ends it at {edge} mm; correct one of the two.</source><translation>Fläche {number} hat einen freien Halbmesser von {rim} mm, aber ihr Radius von {radius} mm lässt sie bei {edge} mm enden; eines von beiden berichtigen.</translation></message>
<message><source>The stop on surface {number} has a semi-diameter of {rim} mm, but a radius of {radius} mm ends that surface at {edge} mm; stop the lens down or move the stop.</source><translation>Die Blende auf Fläche {number} hat einen Halbmesser von {rim} mm, aber ein Radius von {radius} mm lässt diese Fläche bei {edge} mm enden; abblenden oder die Blende versetzen.</translation></message>
<message><source>Every medium of this lens has the index {index}, so no surface bends light; name its glasses.</source><translation>Jedes Medium dieses Objektivs hat den Brechungsindex {index}, also bricht keine Fläche das Licht; seine Gläser nennen.</translation></message>
<message><source>This lens has {count} such oddities; p2sf info lists them all.</source><translation>Dieses Objektiv hat {count} solche Ungereimtheiten; p2sf info zählt sie alle auf.</translation></message>
<message><source>There is no surface {number} in a lens of {count}; choose its row again</source><translation>Eine Fläche {number} gibt es in einem Objektiv von {count} nicht; die Zeile noch einmal wählen</translation></message>
<message><source>{path}, line {number}: {sentence}</source><translation>{path}, Zeile {number}: {sentence}</translation></message>
<message><source>{path}: {sentence}</source><translation>{path}: {sentence}</translation></message>
<message><source>surface {number}: {sentence}</source><translation>Fläche {number}: {sentence}</translation></message>
<message><source>correct it</source><translation>berichtigen</translation></message>
<message><source>correct them</source><translation>berichtigen</translation></message>
<message><source>correct one</source><translation>eines berichtigen</translation></message>
<message><source>correct the line</source><translation>die Zeile berichtigen</translation></message>
<message><source>complete it</source><translation>ergänzen</translation></message>
<message><source>complete the line</source><translation>die Zeile ergänzen</translation></message>
<message><source>complete the command</source><translation>den Befehl ergänzen</translation></message>
<message><source>keep one</source><translation>eines behalten</translation></message>
<message><source>keep exactly one</source><translation>genau eines behalten</translation></message>
<message><source>add it</source><translation>hinzufügen</translation></message>
<message><source>add them</source><translation>hinzufügen</translation></message>
<message><source>give a positive number</source><translation>eine positive Zahl angeben</translation></message>
<message><source>give a finite number</source><translation>eine endliche Zahl angeben</translation></message>
<message><source>give a finite one</source><translation>eine endliche angeben</translation></message>
<message><source>give a number</source><translation>eine Zahl angeben</translation></message>
<message><source>give a number between {low} and {high}</source><translation>eine Zahl zwischen {low} und {high} angeben</translation></message>
<message><source>give at least one</source><translation>mindestens eines angeben</translation></message>
<message><source>give at least 1</source><translation>mindestens 1 angeben</translation></message>
<message><source>give at least one positive number</source><translation>mindestens eine positive Zahl angeben</translation></message>
<message><source>write a number</source><translation>eine Zahl schreiben</translation></message>
<message><source>write at least one number</source><translation>mindestens eine Zahl schreiben</translation></message>
<message><source>write a whole number</source><translation>eine ganze Zahl schreiben</translation></message>
<message><source>write a text in quotation marks</source><translation>einen Text in Anführungszeichen schreiben</translation></message>
<message><source>write a list of numbers as in [1.0, 2.0]</source><translation>eine Liste von Zahlen schreiben wie [1.0, 2.0]</translation></message>
<message><source>write the number {number} without quotation marks</source><translation>die Zahl {number} ohne Anführungszeichen schreiben</translation></message>
<message><source>write {right} with a decimal point, not "{wrong}"</source><translation>{right} mit Dezimalpunkt schreiben, nicht "{wrong}"</translation></message>
<message><source>write one of {names}</source><translation>eines von {names} schreiben</translation></message>
<message><source>choose {something}</source><translation>{something} wählen</translation></message>
<message><source>choose one</source><translation>eines wählen</translation></message>
<message><source>choose one of {names}</source><translation>eines von {names} wählen</translation></message>
<message><source>choose one with some</source><translation>eines mit Licht wählen</translation></message>
<message><source>choose another place</source><translation>einen anderen Ort wählen</translation></message>
<message><source>choose another disk</source><translation>einen anderen Datenträger wählen</translation></message>
<message><source>choose a folder you may write to</source><translation>einen Ordner wählen, in den Sie schreiben dürfen</translation></message>
<message><source>choose a smaller field</source><translation>ein kleineres Feld wählen</translation></message>
<message><source>choose a smaller field or leave clip off</source><translation>ein kleineres Feld wählen oder den Randbeschnitt auslassen</translation></message>
<message><source>choose a longer sweep</source><translation>einen längeren Durchlauf wählen</translation></message>
<message><source>did you mean {names}?</source><translation>ist {names} gemeint?</translation></message>
<message><source>known are {names}</source><translation>bekannt sind {names}</translation></message>
<message><source>known here are {names}</source><translation>hier bekannt sind {names}</translation></message>
<message><source>shipped are {names}</source><translation>mitgeliefert sind {names}</translation></message>
<message><source>known are {names}, A4, A6, …</source><translation>bekannt sind {names}, A4, A6, …</translation></message>
<message><source>check the path</source><translation>den Pfad prüfen</translation></message>
<message><source>check the name</source><translation>den Namen prüfen</translation></message>
<message><source>check its path and permissions</source><translation>Pfad und Rechte prüfen</translation></message>
<message><source>check its coefficients</source><translation>ihre Koeffizienten prüfen</translation></message>
<message><source>check shelf/book/page</source><translation>shelf/book/page prüfen</translation></message>
<message><source>save it again</source><translation>neu speichern</translation></message>
<message><source>save the snapshot again</source><translation>den Schnappschuss neu speichern</translation></message>
<message><source>save the picture again</source><translation>das Bild neu speichern</translation></message>
<message><source>save it as UTF-8</source><translation>als UTF-8 speichern</translation></message>
<message><source>save it again, uncompressed</source><translation>noch einmal speichern, unkomprimiert</translation></message>
<message><source>save it without interlacing, in RGB or grey</source><translation>ohne Interlacing speichern, in RGB oder Grau</translation></message>
<message><source>save it smaller</source><translation>kleiner speichern</translation></message>
<message><source>{claim} samples in {size} bytes, at most {side} on a side and {all} in all</source><translation>{claim} Werte in {size} Byte, höchstens {side} je Seite und {all} im Ganzen</translation></message>
<message><source>{parts} parts in {size} bytes</source><translation>{parts} Teile in {size} Byte</translation></message>
<message><source>save it with 8 or 16 bits or as float</source><translation>mit 8 oder 16 Bit oder als Gleitkomma speichern</translation></message>
<message><source>save as TOML</source><translation>als TOML speichern</translation></message>
<message><source>save as TOML, or give nd and vd</source><translation>als TOML speichern oder nd und vd angeben</translation></message>
<message><source>save it when it is on screen</source><translation>speichern, wenn es zu sehen ist</translation></message>
<message><source>this is no lens file</source><translation>das ist keine Objektivdatei</translation></message>
<message><source>a prescription is far smaller</source><translation>ein Objektiv ist viel kleiner</translation></message>
<message><source>unpack it yourself</source><translation>von Hand auspacken</translation></message>
<message><source>unpack the lens yourself</source><translation>das Objektiv von Hand auspacken</translation></message>
<message><source>only centred lenses are read</source><translation>nur zentrierte Objektive werden gelesen</translation></message>
<message><source>only centred refracting lenses are read</source><translation>nur zentrierte brechende Objektive werden gelesen</translation></message>
<message><source>only refracting lenses are read</source><translation>nur brechende Objektive werden gelesen</translation></message>
<message><source>only round lenses are read</source><translation>nur runde Objektive werden gelesen</translation></message>
<message><source>only even ones are read</source><translation>nur gerade werden gelesen</translation></message>
<message><source>only STANDARD and EVENASPH surfaces are read</source><translation>nur Flächen STANDARD und EVENASPH werden gelesen</translation></message>
<message><source>only 1 to 13 exist, correct it</source><translation>es gibt nur 1 bis 13, berichtigen</translation></message>
<message><source>put it on a surface between</source><translation>auf eine Fläche dazwischen legen</translation></message>
<message><source>put it after one</source><translation>hinter eine Fläche stellen</translation></message>
<message><source>put them in ascending order</source><translation>aufsteigend ordnen</translation></message>
<message><source>sort them</source><translation>ordnen</translation></message>
<message><source>move the object</source><translation>das Objekt verschieben</translation></message>
<message><source>move the source</source><translation>die Quelle verschieben</translation></message>
<message><source>move it</source><translation>verschieben</translation></message>
<message><source>move the object or refocus</source><translation>das Objekt verschieben oder neu fokussieren</translation></message>
<message><source>move the stop off that focus</source><translation>die Blende von diesem Brennpunkt wegrücken</translation></message>
<message><source>replace them first</source><translation>diese zuerst ersetzen</translation></message>
<message><source>take it out or change the glass</source><translation>herausnehmen oder das Glas wechseln</translation></message>
<message><source>take a smaller sensor</source><translation>einen kleineren Sensor nehmen</translation></message>
<message><source>leave {name} out to take the lens as its file has it</source><translation>{name} weglassen, um das Objektiv zu nehmen, wie es in der Datei steht</translation></message>
<message><source>refit the surface</source><translation>die Fläche neu anpassen</translation></message>
<message><source>refit the surface without r²</source><translation>die Fläche ohne r² neu anpassen</translation></message>
<message><source>stop down</source><translation>abblenden</translation></message>
<message><source>stop down, or move the source towards the axis or into focus</source><translation>abblenden oder die Quelle zur Achse oder in den Fokus bringen</translation></message>
<message><source>stop the lens down or reduce the field</source><translation>abblenden oder das Feld verkleinern</translation></message>
<message><source>add them or leave clip off</source><translation>diese hinzufügen oder den Randbeschnitt auslassen</translation></message>
<message><source>leave clip off or reduce the field</source><translation>den Randbeschnitt auslassen oder das Feld verkleinern</translation></message>
<message><source>bring the sensor nearer to the image, stop down, or show a smaller window</source><translation>den Sensor dem Bild nähern, abblenden oder ein kleineres Fenster zeigen</translation></message>
<message><source>bring the depths nearer to focus, stop down, or ask for larger pixels</source><translation>die Abstände dem Fokus nähern, abblenden oder größere Pixel verlangen</translation></message>
<message><source>state the stop's semi-diameter</source><translation>den Halbmesser der Blende angeben</translation></message>
<message><source>state the stop's semi-diameter or the pupil's diameter</source><translation>den Halbmesser der Blende oder den Durchmesser der Pupille angeben</translation></message>
<message><source>state the pupil's diameter or f-number</source><translation>Pupillendurchmesser oder Blendenzahl angeben</translation></message>
<message><source>state one of them</source><translation>eines davon angeben</translation></message>
<message><source>pip install '{name}'</source><translation>pip install '{name}'</translation></message>
<message><source>this program reads version {version}</source><translation>dieses Programm liest Version {version}</translation></message>
<message><source>copy it again from the explorer</source><translation>im Explorer neu kopieren</translation></message>
<message><source>give a .json the explorer has written</source><translation>ein .json angeben, das der Explorer geschrieben hat</translation></message>
<message><source>give a state file that exists</source><translation>eine Zustandsdatei angeben, die es gibt</translation></message>
<message><source>give a lesson as UTF-8 text</source><translation>eine Lektion als UTF-8-Text angeben</translation></message>
<message><source>the file is not text but binary</source><translation>die Datei ist kein Text, sondern binär</translation></message>
<message><source>give the lens as a text file</source><translation>das Objektiv als Textdatei angeben</translation></message>
<message><source>the file has over {count} lines</source><translation>die Datei hat über {count} Zeilen</translation></message>
<message><source>the line has over {count} characters</source><translation>die Zeile hat über {count} Zeichen</translation></message>
<message><source>the file is over {size} MB</source><translation>die Datei ist über {size} MB groß</translation></message>
<message><source>the file is larger than {size} bytes</source><translation>die Datei ist größer als {size} Byte</translation></message>
<message><source>the file is empty</source><translation>die Datei ist leer</translation></message>
<message><source>write a lens into it</source><translation>ein Objektiv hineinschreiben</translation></message>
<message><source>the file is not UTF-8 text</source><translation>die Datei ist kein UTF-8-Text</translation></message>
<message><source>{what} "{word}" is not a number</source><translation>{what} "{word}" ist keine Zahl</translation></message>
<message><source>{what} "{word}" is not a whole number</source><translation>{what} "{word}" ist keine ganze Zahl</translation></message>
<message><source>there is no such file</source><translation>eine solche Datei gibt es nicht</translation></message>
<message><source>this is a folder</source><translation>das ist ein Ordner</translation></message>
<message><source>name a lens file in it</source><translation>eine Objektivdatei darin nennen</translation></message>
<message><source>the file cannot be read ({reason})</source><translation>die Datei ist nicht lesbar ({reason})</translation></message>
<message><source>the file cannot be written ({reason})</source><translation>die Datei ist nicht schreibbar ({reason})</translation></message>
<message><source>the archive cannot be unpacked ({reason})</source><translation>das Archiv lässt sich nicht auspacken ({reason})</translation></message>
<message><source>the archive holds no .zmx or .seq file</source><translation>das Archiv enthält keine .zmx- oder .seq-Datei</translation></message>
<message><source>key "{key}" is unknown</source><translation>der Schlüssel "{key}" ist unbekannt</translation></message>
<message><source>key "{key}" belongs to the top of the file</source><translation>der Schlüssel "{key}" gehört an den Anfang der Datei</translation></message>
<message><source>move it before the first [ heading</source><translation>vor die erste Überschrift [ stellen</translation></message>
<message><source>{key} is missing</source><translation>{key} fehlt</translation></message>
<message><source>unit is "{unit}"</source><translation>die Einheit ist "{unit}"</translation></message>
<message><source>surface is not a list of tables</source><translation>surface ist keine Liste von Tabellen</translation></message>
<message><source>head every surface with [[surface]]</source><translation>jede Fläche mit [[surface]] überschreiben</translation></message>
<message><source>the lens has no surfaces</source><translation>das Objektiv hat keine Flächen</translation></message>
<message><source>write a [[surface]] for each</source><translation>für jede ein [[surface]] schreiben</translation></message>
<message><source>[aperture] states {count} of {names}</source><translation>[aperture] gibt {count} von {names} an</translation></message>
<message><source>write [aperture] and one of {names}</source><translation>[aperture] und eines von {names} schreiben</translation></message>
<message><source>write a surface from 1 to {count}</source><translation>eine Fläche von 1 bis {count} schreiben</translation></message>
<message><source>this is not TOML ({reason})</source><translation>das ist kein TOML ({reason})</translation></message>
<message><source>a number is too long or lists are nested too deep</source><translation>eine Zahl ist zu lang oder Listen sind zu tief verschachtelt</translation></message>
<message><source>lists are nested too deep or a number is too long</source><translation>Listen sind zu tief verschachtelt oder eine Zahl ist zu lang</translation></message>
<message><source>{key} is an empty list</source><translation>{key} ist eine leere Liste</translation></message>
<message><source>wavelength {wave} nm is outside the data of {glass}, {low} to {high} nm</source><translation>die Wellenlänge {wave} nm liegt außerhalb der Daten von {glass}, {low} bis {high} nm</translation></message>
<message><source>medium {name} has no line in a Zemax file</source><translation>das Medium {name} hat keine Zeile in einer Zemax-Datei</translation></message>
<message><source>ending "{ending}" is none of {names}</source><translation>die Endung "{ending}" ist keine von {names}</translation></message>
<message><source>surface {number} has aspheric terms above r^16, for which Zemax has no line</source><translation>Fläche {number} hat asphärische Glieder über r^16, für die Zemax keine Zeile hat</translation></message>
<message><source>the object stands in a medium, which an ISET file cannot say</source><translation>das Objekt steht in einem Medium, was eine ISET-Datei nicht sagen kann</translation></message>
<message><source>an afocal lens has no f-number</source><translation>ein afokales Objektiv hat keine Blendenzahl</translation></message>
<message><source>{glass} shares its name with another maker's glass of this lens</source><translation>{glass} heißt wie das Glas eines anderen Herstellers in diesem Objektiv</translation></message>
<message><source>medium {name} cannot be written to a file</source><translation>das Medium {name} lässt sich nicht in eine Datei schreiben</translation></message>
<message><source>give an index, a glass name or nd and vd</source><translation>einen Index, einen Glasnamen oder nd und vd angeben</translation></message>
<message><source>the file holds no surface between object and image</source><translation>die Datei enthält keine Fläche zwischen Objekt und Bild</translation></message>
<message><source>the file holds no surface (S) between object and image</source><translation>die Datei enthält keine Fläche (S) zwischen Objekt und Bild</translation></message>
<message><source>the file holds no lens surface between object and image</source><translation>die Datei enthält keine Linsenfläche zwischen Objekt und Bild</translation></message>
<message><source>the file holds {count} surfaces</source><translation>die Datei enthält {count} Flächen</translation></message>
<message><source>at most {count} are read</source><translation>höchstens {count} werden gelesen</translation></message>
<message><source>the stop is on the object or the image</source><translation>die Blende liegt auf dem Objekt oder dem Bild</translation></message>
<message><source>mode {mode} is not sequential</source><translation>der Modus {mode} ist nicht sequentiell</translation></message>
<message><source>export the sequential lens</source><translation>das sequentielle Objektiv exportieren</translation></message>
<message><source>lens unit "{unit}" is none of {names}</source><translation>die Längeneinheit "{unit}" ist keine von {names}</translation></message>
<message><source>unit "{unit}" is none of {names}</source><translation>die Einheit "{unit}" ist keine von {names}</translation></message>
<message><source>field type {kind} is none of 0 to 3</source><translation>der Feldtyp {kind} ist keiner von 0 bis 3</translation></message>
<message><source>choose angle or height</source><translation>Winkel oder Höhe wählen</translation></message>
<message><source>wavelength {value} µm is not light</source><translation>die Wellenlänge {value} µm ist kein Licht</translation></message>
<message><source>give micrometres</source><translation>Mikrometer angeben</translation></message>
<message><source>a wavelength is not light</source><translation>eine Wellenlänge ist kein Licht</translation></message>
<message><source>give nanometres</source><translation>Nanometer angeben</translation></message>
<message><source>surface {number} stands where {due} is due</source><translation>Fläche {number} steht, wo {due} kommen müsste</translation></message>
<message><source>{surface} has type {kind}, {why}</source><translation>{surface} hat den Typ {kind}, {why}</translation></message>
<message><source>{surface} has an infinite thickness</source><translation>{surface} hat eine unendliche Dicke</translation></message>
<message><source>has an infinite thickness</source><translation>hat eine unendliche Dicke</translation></message>
<message><source>{surface} has a rim decentred by ({x}, {y})</source><translation>{surface} hat einen um ({x}, {y}) dezentrierten Rand</translation></message>
<message><source>has a rim decentred by ({x}, {y})</source><translation>hat einen um ({x}, {y}) dezentrierten Rand</translation></message>
<message><source>{surface} is a mirror</source><translation>{surface} ist ein Spiegel</translation></message>
<message><source>is a mirror</source><translation>ist ein Spiegel</translation></message>
<message><source>{surface} is a mirror (REFL)</source><translation>{surface} ist ein Spiegel (REFL)</translation></message>
<message><source>which P2SF does not trace</source><translation>das P2SF nicht rechnet</translation></message>
<message><source>the shipped lenses are missing</source><translation>die mitgelieferten Objektive fehlen</translation></message>
<message><source>install p2sf again</source><translation>p2sf neu installieren</translation></message>
<message><source>lens "{name}" is neither shipped nor a file</source><translation>das Objektiv "{name}" ist weder mitgeliefert noch eine Datei</translation></message>
<message><source>{name} speaks of surface {place}, which is not there yet</source><translation>{name} spricht von Fläche {place}, die es noch nicht gibt</translation></message>
<message><source>{name} stands before any surface</source><translation>{name} steht vor jeder Fläche</translation></message>
<message><source>private glass {name} has no wavelengths (PWL) before it</source><translation>dem privaten Glas {name} gehen keine Wellenlängen (PWL) voraus</translation></message>
<message><source>private glass {name} has not one index per wavelength</source><translation>das private Glas {name} hat nicht einen Index je Wellenlänge</translation></message>
<message><source>private glass {name}: {why}</source><translation>privates Glas {name}: {why}</translation></message>
<message><source>glass "{word}" is neither a name nor a six-digit code such as 517642 or 517.642</source><translation>das Glas "{word}" ist weder ein Name noch ein sechsstelliger Code wie 517642 oder 517.642</translation></message>
<message><source>the file states no aperture, no stop and no semi-diameter</source><translation>die Datei nennt weder Öffnung noch Blende noch Halbmesser</translation></message>
<message><source>add one of them</source><translation>eines davon hinzufügen</translation></message>
<message><source>the aperture ({kind} {value}) fills the stop to {rim} mm</source><translation>die Öffnung ({kind} {value}) füllt die Blende bis {rim} mm</translation></message>
<message><source>an object at infinity has no numerical aperture</source><translation>ein Objekt im Unendlichen hat keine numerische Apertur</translation></message>
<message><source>the object lies in the first vertex, where an aperture angle fills no stop</source><translation>das Objekt liegt im ersten Scheitel, wo ein Öffnungswinkel keine Blende füllt</translation></message>
<message><source>numerical aperture {na} is impossible in index {index}</source><translation>die numerische Apertur {na} ist im Index {index} unmöglich</translation></message>
<message><source>field heights have no angle for this lens</source><translation>Feldhöhen haben bei diesem Objektiv keinen Winkel</translation></message>
<message><source>field angle {angle}° is not below 90°</source><translation>der Feldwinkel {angle}° liegt nicht unter 90°</translation></message>
<message><source>the row cannot be cut into cells ({why})</source><translation>die Zeile lässt sich nicht in Zellen teilen ({why})</translation></message>
<message><source>surfaces {a} and {b} both are the stop</source><translation>die Flächen {a} und {b} sind beide die Blende</translation></message>
<message><source>surfaces {a} and {b} both are stops</source><translation>die Flächen {a} und {b} sind beide Blenden</translation></message>
<message><source>the file is none of the formats known here: {names}</source><translation>die Datei hat keines der hier bekannten Formate: {names}</translation></message>
<message><source>this is a glass catalogue, not a lens</source><translation>das ist ein Glaskatalog, kein Objektiv</translation></message>
<message><source>give it beside a lens file</source><translation>neben einer Objektivdatei angeben</translation></message>
<message><source>the file holds no list of surfaces</source><translation>die Datei enthält keine Liste von Flächen</translation></message>
<message><source>surface {number} is tilted or decentred (transform)</source><translation>Fläche {number} ist gekippt oder dezentriert (transform)</translation></message>
<message><source>surface {number}: {key} differs between x and y</source><translation>Fläche {number}: {key} unterscheidet sich zwischen x und y</translation></message>
<message><source>{key} differs between x and y</source><translation>{key} unterscheidet sich zwischen x und y</translation></message>
<message><source>aspheric_coefficients is not a list of up to 20 numbers</source><translation>aspheric_coefficients ist keine Liste von bis zu 20 Zahlen</translation></message>
<message><source>ior is neither a number nor [[nm …], [n …]]</source><translation>ior ist weder eine Zahl noch [[nm …], [n …]]</translation></message>
<message><source>surface {number} is not an object with radius and thickness</source><translation>Fläche {number} ist kein Objekt mit radius und thickness</translation></message>
<message><source>a row has {count} columns</source><translation>eine Zeile hat {count} Spalten</translation></message>
<message><source>write radius, thickness, index, diameter</source><translation>Radius, Dicke, Index, Durchmesser schreiben</translation></message>
<message><source>this is not JSON ({why})</source><translation>das ist kein JSON ({why})</translation></message>
<message><source>ior is no table of wavelengths and indices ({why})</source><translation>ior ist keine Tabelle von Wellenlängen und Indizes ({why})</translation></message>
<message><source>glass has the keys {names}</source><translation>glass hat die Schlüssel {names}</translation></message>
<message><source>write a number from 1 to 13</source><translation>eine Zahl von 1 bis 13 schreiben</translation></message>
<message><source>coefficients of {name} are not up to {count} numbers</source><translation>die Koeffizienten von {name} sind nicht bis zu {count} Zahlen</translation></message>
<message><source>write the shortest and the longest wavelength</source><translation>die kürzeste und die längste Wellenlänge schreiben</translation></message>
<message><source>the aspheres have odd powers (AsphericalOddCount)</source><translation>die Asphären haben ungerade Potenzen (AsphericalOddCount)</translation></message>
<message><source>a row of lens data needs number, radius and distance</source><translation>eine Zeile der Linsendaten braucht Nummer, Radius und Abstand</translation></message>
<message><source>distance "{word}" has no value in [variable distances]</source><translation>der Abstand "{word}" hat keinen Wert in [variable distances]</translation></message>
<message><source>aspherical data of "{word}", which is no row of the lens data</source><translation>asphärische Daten von "{word}", was keine Zeile der Linsendaten ist</translation></message>
<message><source>a row of aspherical data needs number, radius, conic</source><translation>eine Zeile asphärischer Daten braucht Nummer, Radius, Kegelschnitt</translation></message>
<message><source>radius {value} differs from the lens data's</source><translation>der Radius {value} weicht von dem der Linsendaten ab</translation></message>
<message><source>glass {name} of {path} has nd {nd} by its coefficients and {listed} by its name line</source><translation>das Glas {name} aus {path} hat nd {nd} nach seinen Koeffizienten und {listed} nach seiner Namenszeile</translation></message>
<message><source>the catalogue is damaged, replace it</source><translation>der Katalog ist beschädigt, ersetzen</translation></message>
<message><source>{glass} is in no catalogue</source><translation>{glass} steht in keinem Katalog</translation></message>
<message><source>give its AGF catalogue, or its index as nd and vd</source><translation>seinen AGF-Katalog angeben oder seinen Index als nd und vd</translation></message>
<message><source>{glass} is in no catalogue given</source><translation>{glass} steht in keinem angegebenen Katalog</translation></message>
<message><source>accept a substitute ({names}) or give its AGF catalogue</source><translation>einen Ersatz annehmen ({names}) oder seinen AGF-Katalog angeben</translation></message>
<message><source>no glass (NM and CD lines) is in this file</source><translation>in dieser Datei ist kein Glas (Zeilen NM und CD)</translation></message>
<message><source>give an AGF catalogue</source><translation>einen AGF-Katalog angeben</translation></message>
<message><source>a glass needs a name and a formula number (NM name formula …)</source><translation>ein Glas braucht Namen und Formelnummer (NM Name Formel …)</translation></message>
<message><source>{name} uses dispersion formula {formula}</source><translation>{name} benutzt die Dispersionsformel {formula}</translation></message>
<message><source>the glass has no coefficients (CD line)</source><translation>das Glas hat keine Koeffizienten (Zeile CD)</translation></message>
<message><source>the glass has no wavelength range (LD line)</source><translation>das Glas hat keinen Wellenlängenbereich (Zeile LD)</translation></message>
<message><source>the glass's range is {low} to {high} µm</source><translation>der Bereich des Glases ist {low} bis {high} µm</translation></message>
<message><source>give the smaller first, both positive</source><translation>das kleinere zuerst angeben, beide positiv</translation></message>
<message><source>formula {formula} of {name} gives no real index there</source><translation>Formel {formula} von {name} ergibt dort keinen reellen Index</translation></message>
<message><source>surface {number}: the r² coefficient {value} beside a radius of curvature is not a conic with terms from r⁴ on</source><translation>Fläche {number}: der r²-Koeffizient {value} neben einem Krümmungsradius ist kein Kegelschnitt mit Gliedern ab r⁴</translation></message>
<message><source>the r² coefficient {value} beside a radius of curvature is not a conic with terms from r⁴ on</source><translation>der r²-Koeffizient {value} neben einem Krümmungsradius ist kein Kegelschnitt mit Gliedern ab r⁴</translation></message>
<message><source>aspheric term r^{power} is not even from r⁴ on</source><translation>das asphärische Glied r^{power} ist nicht gerade ab r⁴</translation></message>
<message><source>a number is too large or too small for a lens</source><translation>eine Zahl ist zu groß oder zu klein für ein Objektiv</translation></message>
<message><source>the aperture is {value}</source><translation>die Öffnung ist {value}</translation></message>
<message><source>glass "{name}" is in no catalogue</source><translation>das Glas "{name}" steht in keinem Katalog</translation></message>
<message><source>glass "{name}" is not in the catalogue of {maker}</source><translation>das Glas "{name}" steht nicht im Katalog von {maker}</translation></message>
<message><source>glass "{name}" is sold with different indices as {names}</source><translation>das Glas "{name}" wird mit verschiedenen Indizes verkauft als {names}</translation></message>
<message><source>write the one you mean</source><translation>das gemeinte schreiben</translation></message>
<message><source>glass "{name}" is listed with its absorption only</source><translation>das Glas "{name}" ist nur mit seiner Absorption verzeichnet</translation></message>
<message><source>give its index or nd and vd</source><translation>seinen Index oder nd und vd angeben</translation></message>
<message><source>glass "{name}": refractiveindex.info has no such page</source><translation>Glas "{name}": refractiveindex.info hat keine solche Seite</translation></message>
<message><source>glass is {value}</source><translation>glass ist {value}</translation></message>
<message><source>write a name such as "SCHOTT N-BK7", an index, or nd and vd</source><translation>einen Namen wie "SCHOTT N-BK7", einen Index oder nd und vd schreiben</translation></message>
<message><source>write { nd = 1.5168, vd = 64.17 } or { wavelengths_um = […], n = […] }</source><translation>{ nd = 1.5168, vd = 64.17 } oder { wavelengths_um = […], n = […] } schreiben</translation></message>
<message><source>give an index between 1 and 4</source><translation>einen Index zwischen 1 und 4 angeben</translation></message>
<message><source>give an Abbe number between 10 and 120</source><translation>eine Abbe-Zahl zwischen 10 und 120 angeben</translation></message>
<message><source>refractive index is {value}</source><translation>der Brechungsindex ist {value}</translation></message>
<message><source>glass "{name}" is a mirror, which P2SF does not trace</source><translation>das Glas "{name}" ist ein Spiegel, den P2SF nicht rechnet</translation></message>
<message><source>give a refracting lens</source><translation>ein brechendes Objektiv angeben</translation></message>
<message><source>glass table needs two equally long lists of numbers</source><translation>die Glastabelle braucht zwei gleich lange Listen von Zahlen</translation></message>
<message><source>give wavelengths_um and n</source><translation>wavelengths_um und n angeben</translation></message>
<message><source>glass table's wavelengths are {values} µm</source><translation>die Wellenlängen der Glastabelle sind {values} µm</translation></message>
<message><source>stop surface {number} does not exist</source><translation>die Blendenfläche {number} gibt es nicht</translation></message>
<message><source>the lens has surfaces 1 to {count}</source><translation>das Objektiv hat die Flächen 1 bis {count}</translation></message>
<message><source>aperture {kind} is {value}</source><translation>die Öffnung {kind} ist {value}</translation></message>
<message><source>wavelengths are {values} nm</source><translation>die Wellenlängen sind {values} nm</translation></message>
<message><source>surface {number}: radius {value} mm</source><translation>Fläche {number}: Radius {value} mm</translation></message>
<message><source>radius {value} mm</source><translation>Radius {value} mm</translation></message>
<message><source>write inf for a plane</source><translation>inf für eine Ebene schreiben</translation></message>
<message><source>surface {number}: thickness {value} mm</source><translation>Fläche {number}: Dicke {value} mm</translation></message>
<message><source>thickness {value} mm</source><translation>Dicke {value} mm</translation></message>
<message><source>surface {number}: semi-diameter {value} mm</source><translation>Fläche {number}: Halbmesser {value} mm</translation></message>
<message><source>semi-diameter {value} mm</source><translation>Halbmesser {value} mm</translation></message>
<message><source>conic or aspheric coefficient is not finite</source><translation>der Kegelschnitt oder ein asphärischer Koeffizient ist nicht endlich</translation></message>
<message><source>surface {number} has no rim to be the stop</source><translation>Fläche {number} hat keinen Rand, der Blende sein könnte</translation></message>
<message><source>give it a semi-diameter first</source><translation>ihr zuerst einen Halbmesser geben</translation></message>
<message><source>a lens needs at least one surface</source><translation>ein Objektiv braucht mindestens eine Fläche</translation></message>
<message><source>insert another before deleting this one</source><translation>eine andere einfügen, bevor diese gelöscht wird</translation></message>
<message><source>surface {number} is the stop</source><translation>Fläche {number} ist die Blende</translation></message>
<message><source>put the stop on another surface before deleting it</source><translation>die Blende auf eine andere Fläche legen, bevor diese gelöscht wird</translation></message>
<message><source>a film has no ending "{ending}"</source><translation>ein Film hat nicht die Endung "{ending}"</translation></message>
<message><source>there is no frame to write</source><translation>es gibt kein Bild zu schreiben</translation></message>
<message><source>{path} cannot be written, {reason}</source><translation>{path} ist nicht schreibbar, {reason}</translation></message>
<message><source>the export was cancelled</source><translation>der Export wurde abgebrochen</translation></message>
<message><source>nothing was written</source><translation>nichts wurde geschrieben</translation></message>
<message><source>the image is at infinity, so no sensor position is in focus</source><translation>das Bild liegt im Unendlichen, also ist kein Sensorort scharf</translation></message>
<message><source>"{word}" sets nothing</source><translation>"{word}" stellt nichts ein</translation></message>
<message><source>write entries such as field_deg 10, tab mtf</source><translation>Einträge schreiben wie field_deg 10, tab mtf</translation></message>
<message><source>"{text}" in a claim is no number</source><translation>"{text}" in einer Behauptung ist keine Zahl</translation></message>
<message><source>write one such as 0.25 or 1e-3</source><translation>eine wie 0.25 oder 1e-3 schreiben</translation></message>
<message><source>"{text}" is no claim</source><translation>"{text}" ist keine Behauptung</translation></message>
<message><source>write one such as {example}</source><translation>eine schreiben wie {example}</translation></message>
<message><source>measure "{name}" is unknown</source><translation>das Maß "{name}" ist unbekannt</translation></message>
<message><source>"{text}": "is" needs a tolerance such as ± 0.01, and "above" and "below" take none</source><translation>"{text}": "is" braucht eine Toleranz wie ± 0.01, "above" und "below" haben keine</translation></message>
<message><source>{there} of words, and the lesson has {count}</source><translation>{there} mit Worten, und die Lektion hat {count}</translation></message>
<message><source>there is 1 step</source><translation>es gibt 1 Schritt</translation></message>
<message><source>there are {count} steps</source><translation>es gibt {count} Schritte</translation></message>
<message><source>say each in its place</source><translation>jeden an seiner Stelle sagen</translation></message>
<message><source>there is no step</source><translation>es gibt keinen Schritt</translation></message>
<message><source>begin one with a line such as ## A point becomes a patch</source><translation>einen mit einer Zeile beginnen wie ## Aus einem Punkt wird ein Fleck</translation></message>
<message><source>a lesson begins with a line "{line}"</source><translation>eine Lektion beginnt mit einer Zeile "{line}"</translation></message>
<message><source>put title, about and lens below it</source><translation>title, about und lens darunter schreiben</translation></message>
<message><source>the header has no end</source><translation>der Kopf hat kein Ende</translation></message>
<message><source>close it with a line "{line}"</source><translation>ihn mit einer Zeile "{line}" schließen</translation></message>
<message><source>a question and its answer go together</source><translation>eine Frage und ihre Antwort gehören zusammen</translation></message>
<message><source>give both ask: and tell:</source><translation>ask: und tell: angeben</translation></message>
<message><source>{path} cannot be read ({reason})</source><translation>{path} ist nicht lesbar ({reason})</translation></message>
<message><source>"{line}" is no entry of the header</source><translation>"{line}" ist kein Eintrag des Kopfes</translation></message>
<message><source>the header lacks "{name}"</source><translation>dem Kopf fehlt "{name}"</translation></message>
<message><source>add a line such as {line}</source><translation>eine Zeile hinzufügen wie {line}</translation></message>
<message><source>"{name}:" is no entry of a step here</source><translation>"{name}:" ist hier kein Eintrag eines Schritts</translation></message>
<message><source>"{name}" is no slider</source><translation>"{name}" ist kein Regler</translation></message>
<message><source>move one of {names}</source><translation>einen von {names} bewegen</translation></message>
<message><source>this stands before the first step</source><translation>das steht vor dem ersten Schritt</translation></message>
<message><source>begin a step with a line ## and its title</source><translation>einen Schritt mit einer Zeile ## und seinem Titel beginnen</translation></message>
<message><source>the link holds no state of the explorer</source><translation>der Link enthält keinen Zustand des Explorers</translation></message>
<message><source>the link has version {version}</source><translation>der Link hat Version {version}</translation></message>
<message><source>the link is cut off or changed</source><translation>der Link ist abgeschnitten oder verändert</translation></message>
<message><source>copy all of it again, from p2sf: to its last letter</source><translation>noch einmal ganz kopieren, von p2sf: bis zum letzten Zeichen</translation></message>
<message><source>there is no picture yet</source><translation>es gibt noch kein Bild</translation></message>
<message><source>the {words} "{text}" has the unit "{unit}"</source><translation>{words}: "{text}" hat die Einheit "{unit}"</translation></message>
<message><source>the {words} "{text}" is not a number</source><translation>{words}: "{text}" ist keine Zahl</translation></message>
<message><source>write one such as 12.5</source><translation>eine schreiben wie 12.5</translation></message>
<message><source>write the number alone</source><translation>die Zahl allein schreiben</translation></message>
<message><source>write {names} or no unit</source><translation>{names} oder keine Einheit schreiben</translation></message>
<message><source>PSF data has no ending "{ending}"</source><translation>PSF-Daten haben nicht die Endung "{ending}"</translation></message>
<message><source>a picture of the window ends in ".png", not "{ending}"</source><translation>ein Bild des Fensters endet auf ".png", nicht "{ending}"</translation></message>
<message><source>change the ending</source><translation>die Endung ändern</translation></message>
<message><source>{path} cannot be written, the draft beside it stayed empty</source><translation>{path} ist nicht schreibbar, der Entwurf daneben blieb leer</translation></message>
<message><source>this set-up has no PSF</source><translation>diese Einstellung hat keine PSF</translation></message>
<message><source>change it until there is a picture</source><translation>sie ändern, bis es ein Bild gibt</translation></message>
<message><source>{name} has the ending "{ending}"</source><translation>{name} hat die Endung "{ending}"</translation></message>
<message><source>give the scene a name in {names}</source><translation>der Szene einen Namen mit {names} geben</translation></message>
<message><source>the added waves are {waves}</source><translation>die hinzugefügten Wellen sind {waves}</translation></message>
<message><source>give {count} numbers, for {names}</source><translation>{count} Zahlen angeben, für {names}</translation></message>
<message><source>give true or false</source><translation>true oder false angeben</translation></message>
<message><source>list some of {names}, each once and in this order</source><translation>einige von {names} nennen, jedes einmal und in dieser Reihenfolge</translation></message>
<message><source>shown is "{side}" and nothing is pinned as B</source><translation>gezeigt wird "{side}", und nichts ist als B gemerkt</translation></message>
<message><source>pin a state first (Ctrl+B)</source><translation>zuerst einen Zustand merken (Strg+B)</translation></message>
<message><source>play is "{name}"</source><translation>play ist "{name}"</translation></message>
<message><source>name a slider: {names}</source><translation>einen Regler nennen: {names}</translation></message>
<message><source>the range to play is {values}</source><translation>der Bereich zum Abspielen ist {values}</translation></message>
<message><source>give where it begins and where it ends</source><translation>angeben, wo er beginnt und wo er endet</translation></message>
<message><source>the state's windows must be a list of panels' names</source><translation>die Fenster des Zustands müssen eine Liste von Ansichten sein</translation></message>
<message><source>correct it or leave it out</source><translation>berichtigen oder weglassen</translation></message>
<message><source>the state has an unknown entry "{name}"</source><translation>der Zustand hat einen unbekannten Eintrag "{name}"</translation></message>
<message><source>{path} is not a state of the explorer</source><translation>{path} ist kein Zustand des Explorers</translation></message>
<message><source>{path} has version {version}</source><translation>{path} hat Version {version}</translation></message>
<message><source>the state names no lens</source><translation>der Zustand nennt kein Objektiv</translation></message>
<message><source>give the name of a shipped lens or a path</source><translation>den Namen eines mitgelieferten Objektivs oder einen Pfad angeben</translation></message>
<message><source>the state's edited lens is not text</source><translation>das bearbeitete Objektiv des Zustands ist kein Text</translation></message>
<message><source>the state's clip must be true or false, and its tab a panel's name</source><translation>clip muss im Zustand true oder false sein und tab der Name einer Ansicht</translation></message>
<message><source>not JSON ({why})</source><translation>kein JSON ({why})</translation></message>
<message><source>correct it or save it again</source><translation>berichtigen oder neu speichern</translation></message>
<message><source>no PSF of this lens is sharp enough for the atlas</source><translation>keine PSF dieses Objektivs ist scharf genug für den Atlas</translation></message>
<message><source>no chief ray of this lens's field reaches the sensor</source><translation>kein Hauptstrahl aus dem Feld dieses Objektivs erreicht den Sensor</translation></message>
<message><source>choose a part of the field instead</source><translation>stattdessen einen Teil des Feldes wählen</translation></message>
<message><source>points blur over {size} mm here, too much to wait for</source><translation>Punkte verschwimmen hier über {size} mm, zu viel, um darauf zu warten</translation></message>
<message><source>{name} has changed on disk</source><translation>{name} hat sich auf dem Datenträger geändert</translation></message>
<message><source>your edits are kept, Back to file takes the new one</source><translation>Ihre Änderungen bleiben, „Zurück zur Datei“ nimmt die neue</translation></message>
<message><source>{name} has changed on disk and was read again</source><translation>{name} hat sich auf dem Datenträger geändert und wurde neu gelesen</translation></message>
<message><source>{why}, so moving the sensor does not focus</source><translation>{why}, also stellt ein anderer Ort des Sensors nicht scharf</translation></message>
<message><source>set Wd by its slider, or reset the what-if</source><translation>Wd am Regler einstellen oder das Was-wäre-wenn zurücksetzen</translation></message>
<message><source>cannot compare {shapes}</source><translation>{shapes} sind nicht vergleichbar</translation></message>
<message><source>render both on the same grid</source><translation>beide auf demselben Gitter rechnen</translation></message>
<message><source>a phase slope of {slope} waves over a window of {reach} cycles needs {rows} × {columns} pupil samples</source><translation>eine Phasensteigung von {slope} Wellen über ein Fenster von {reach} Perioden braucht {rows} × {columns} Pupillenproben</translation></message>
<message><source>chart "{name}" is unknown</source><translation>die Tafel "{name}" ist unbekannt</translation></message>
<message><source>the spectrum {name} has no light that the eye sees</source><translation>das Spektrum {name} hat kein Licht, das das Auge sieht</translation></message>
<message><source>the entrance pupil is at infinity, so a field angle says nothing</source><translation>die Eintrittspupille liegt im Unendlichen, also sagt ein Feldwinkel nichts</translation></message>
<message><source>move the stop off that focus, or in Python state the field as an object height, field="height"</source><translation>die Blende von diesem Brennpunkt wegrücken oder in Python das Feld als Objekthöhe angeben, field="height"</translation></message>
<message><source>the object lies in the entrance pupil, so no cone of light is defined</source><translation>das Objekt liegt in der Eintrittspupille, also ist kein Lichtkegel festgelegt</translation></message>
<message><source>depth is {value} mm</source><translation>der Objektabstand ist {value} mm</translation></message>
<message><source>the object must stand a positive distance before the first vertex</source><translation>das Objekt muss in einem positiven Abstand vor dem ersten Scheitel stehen</translation></message>
<message><source>no ray but the chief ray reaches the sensor</source><translation>kein Strahl außer dem Hauptstrahl erreicht den Sensor</translation></message>
<message><source>this blur over {pixels} pixels of {pitch} µm needs {count} rays</source><translation>diese Unschärfe über {pixels} Pixel zu {pitch} µm braucht {count} Strahlen</translation></message>
<message><source>this blur over {pixels} pixels of {pitch} µm needs {rows} × {columns} pupil samples</source><translation>diese Unschärfe über {pixels} Pixel zu {pitch} µm braucht {rows} × {columns} Pupillenproben</translation></message>
<message><source>a blur of {pixels} pixels with {samples} samples each needs a {side}² transform</source><translation>eine Unschärfe von {pixels} Pixeln mit je {samples} Proben braucht eine Transformation von {side}²</translation></message>
<message><source>the image lies at infinity, so the sensor sees no blur of finite size</source><translation>das Bild liegt im Unendlichen, der Sensor sieht also keine Unschärfe endlicher Größe</translation></message>
<message><source>no chief ray of an object at {depth} lands {height} mm from the axis, where the sensor's corner is</source><translation>kein Hauptstrahl eines Objekts bei {depth} landet {height} mm neben der Achse, wo die Ecke des Sensors ist</translation></message>
<message><source>FITS files need astropy, which is not installed</source><translation>FITS-Dateien brauchen astropy, das nicht installiert ist</translation></message>
<message><source>{path} is not a PSF that this program wrote as FITS</source><translation>{path} ist keine PSF, die dieses Programm als FITS geschrieben hat</translation></message>
<message><source>{path} is not a PSF that this program wrote</source><translation>{path} ist keine PSF, die dieses Programm geschrieben hat</translation></message>
<message><source>export it again with p2sf psf -o</source><translation>mit p2sf psf -o neu ausgeben</translation></message>
<message><source>{path} cannot be read, {reason}</source><translation>{path} ist nicht lesbar, {reason}</translation></message>
<message><source>give the path of a PNG or TIFF</source><translation>den Pfad eines PNG oder TIFF angeben</translation></message>
<message><source>{path} holds values that are not finite</source><translation>{path} enthält Werte, die nicht endlich sind</translation></message>
<message><source>a {ending} of depth {depth} cannot be written</source><translation>ein {ending} der Tiefe {depth} lässt sich nicht schreiben</translation></message>
<message><source>choose 8 or 16, or float in a .tif</source><translation>8 oder 16 wählen, oder Gleitkomma in einem .tif</translation></message>
<message><source>{path} has the ending "{ending}", which is no picture here</source><translation>{path} hat die Endung "{ending}", was hier kein Bild ist</translation></message>
<message><source>{path} holds {kind} samples</source><translation>{path} enthält Werte vom Typ {kind}</translation></message>
<message><source>{path} has the shape {shape}</source><translation>{path} hat die Form {shape}</translation></message>
<message><source>give one picture of 1 or 3 channels</source><translation>ein Bild mit 1 oder 3 Kanälen angeben</translation></message>
<message><source>{path} is a TIFF that cannot be read ({why})</source><translation>{path} ist ein TIFF, das nicht lesbar ist ({why})</translation></message>
<message><source>{path} is neither a PNG nor a TIFF that can be read</source><translation>{path} ist weder ein PNG noch ein lesbares TIFF</translation></message>
<message><source>convert it to one</source><translation>in eines davon umwandeln</translation></message>
<message><source>{path} is an interlaced or indexed 16-bit PNG</source><translation>{path} ist ein verschachteltes oder indiziertes 16-Bit-PNG</translation></message>
<message><source>{path} is too large a PNG ({why})</source><translation>{path} ist ein zu großes PNG ({why})</translation></message>
<message><source>{path} is a damaged PNG ({why})</source><translation>{path} ist ein beschädigtes PNG ({why})</translation></message>
<message><source>an FFT of {count} × {count} pupil samples is too large</source><translation>eine FFT von {count} × {count} Pupillenproben ist zu groß</translation></message>
<message><source>use mdft or change the pixel</source><translation>mdft nehmen oder das Pixel ändern</translation></message>
<message><source>{what} is not finite, so there is no wavefront</source><translation>{what} ist nicht endlich, also gibt es keine Wellenfront</translation></message>
<message><source>choose a depth, field or lens with one</source><translation>einen Abstand, ein Feld oder ein Objektiv mit einer wählen</translation></message>
<message><source>the lens names no stop surface and no semi-diameters</source><translation>das Objektiv nennt weder Blendenfläche noch Halbmesser</translation></message>
<message><source>the entrance pupil is at infinity, so it has no diameter</source><translation>die Eintrittspupille liegt im Unendlichen, hat also keinen Durchmesser</translation></message>
<message><source>an object at infinity has no height</source><translation>ein Objekt im Unendlichen hat keine Höhe</translation></message>
<message><source>give the field as an angle or an image height</source><translation>das Feld als Winkel oder Bildhöhe angeben</translation></message>
<message><source>every chief ray meets the sensor on the axis</source><translation>jeder Hauptstrahl trifft den Sensor auf der Achse</translation></message>
<message><source>give the field as an angle</source><translation>das Feld als Winkel angeben</translation></message>
<message><source>{lost} of {all} rays do not reach the sensor</source><translation>{lost} von {all} Strahlen erreichen den Sensor nicht</translation></message>
<message><source>the lens states no semi-diameters, so nothing can be clipped</source><translation>das Objektiv nennt keine Halbmesser, also lässt sich nichts beschneiden</translation></message>
<message><source>the chief ray {what}</source><translation>der Hauptstrahl {what}</translation></message>
<message><source>no ray reaches the sensor</source><translation>kein Strahl erreicht den Sensor</translation></message>
<message><source>the clear part of the pupil has no clear centre</source><translation>der freie Teil der Pupille hat keine freie Mitte</translation></message>
<message><source>{what} is {value}, which needs a chief ray at 90° to the axis</source><translation>{what} ist {value}, wofür der Hauptstrahl 90° zur Achse stehen müsste</translation></message>
<message><source>give a smaller one</source><translation>ein kleineres angeben</translation></message>
<message><source>Sensor shift is {shift} µm, which moves the sensor from {place} mm behind the lens into it</source><translation>der Sensorversatz ist {shift} µm, was den Sensor von {place} mm hinter dem Objektiv in dieses hinein schiebt</translation></message>
<message><source>give a smaller shift</source><translation>einen kleineren Versatz angeben</translation></message>
<message><source>{what} is {value}, but the image of that distance lies {where} and not on a sensor behind the lens</source><translation>{what} ist {value}, aber das Bild dieses Abstands liegt {where} und nicht auf einem Sensor hinter dem Objektiv</translation></message>
<message><source>{place} mm from the last vertex</source><translation>{place} mm vom letzten Scheitel</translation></message>
<message><source>give a distance whose image is real, as a rule a longer one</source><translation>einen Abstand angeben, dessen Bild reell ist, meist einen größeren</translation></message>
<message><source>Field is {value}°, and no ray at 90° or more from the axis enters a lens</source><translation>das Feld ist {value}°, und kein Strahl tritt bei 90° oder mehr zur Achse in ein Objektiv ein</translation></message>
<message><source>give an angle between −90 and 90°, both ends left out</source><translation>einen Winkel zwischen −90 und 90° angeben, beide Enden ausgenommen</translation></message>
<message><source>the field is stated {count} times, by {names}</source><translation>das Feld ist {count}-mal angegeben, durch {names}</translation></message>
<message><source>rims clip {lost} of {all} rays, and {method} describes the whole pupil</source><translation>Ränder nehmen {lost} von {all} Strahlen weg, und {method} beschreibt die ganze Pupille</translation></message>
<message><source>choose traced or huygens, or leave clip off</source><translation>traced oder huygens wählen oder den Randbeschnitt auslassen</translation></message>
<message><source>method "{method}" is unknown</source><translation>die Methode "{method}" ist unbekannt</translation></message>
<message><source>a tolerance of {value}</source><translation>eine Toleranz von {value}</translation></message>
<message><source>give the R² to hold, below 1</source><translation>das einzuhaltende R² angeben, unter 1</translation></message>
<message><source>the spectrum "{kind}" takes no number, not {number}</source><translation>das Spektrum "{kind}" hat keine Zahl, auch nicht {number}</translation></message>
<message><source>the black body has {values} K</source><translation>der Schwarze Körper hat {values} K</translation></message>
<message><source>give one temperature from {low} to {high} K, as in planck:5600</source><translation>eine Temperatur von {low} bis {high} K angeben, wie in planck:5600</translation></message>
<message><source>the spectral lines are {values} nm</source><translation>die Spektrallinien sind {values} nm</translation></message>
<message><source>give wavelengths from {low} to {high} nm, as in lines:486,588,656</source><translation>Wellenlängen von {low} bis {high} nm angeben, wie in lines:486,588,656</translation></message>
<message><source>the spectrum "{kind}" is unknown</source><translation>das Spektrum "{kind}" ist unbekannt</translation></message>
<message><source>the spectrum "{text}" holds "{rest}", which is no list of numbers</source><translation>das Spektrum "{text}" enthält "{rest}", was keine Liste von Zahlen ist</translation></message>
<message><source>stop "{mode}" is unknown</source><translation>die Blende "{mode}" ist unbekannt</translation></message>
<message><source>misses surface {number}</source><translation>verfehlt Fläche {number}</translation></message>
<message><source>is totally reflected at surface {number}</source><translation>wird an Fläche {number} total reflektiert</translation></message>
<message><source>{name} is cut short or damaged at its end</source><translation>{name} ist abgeschnitten oder am Ende beschädigt</translation></message>
<message><source>copy or build it again</source><translation>neu kopieren oder bauen</translation></message>
<message><source>{key} is {number}</source><translation>{key} ist {number}</translation></message>
<message><source>{key} is "{word}"</source><translation>{key} ist "{word}"</translation></message>
<message><source>{where}: {what} is missing</source><translation>{where}: {what} fehlt</translation></message>
<message><source>give a lens</source><translation>ein Objektiv angeben</translation></message>
<message><source>the image is at ∞, so no sensor position is in focus</source><translation>das Bild liegt im Unendlichen, also ist kein Sensorort scharf</translation></message>
<message><source>an object at ∞ has no numerical aperture</source><translation>ein Objekt im Unendlichen hat keine numerische Apertur</translation></message>
<message><source>the image lies at ∞, so the sensor sees no blur of finite size</source><translation>das Bild liegt im Unendlichen, der Sensor sieht also keine Unschärfe endlicher Größe</translation></message>
<message><source>the entrance pupil is at ∞, so a field angle says nothing</source><translation>die Eintrittspupille liegt im Unendlichen, also sagt ein Feldwinkel nichts</translation></message>
<message><source>the entrance pupil is at ∞, so it has no diameter</source><translation>die Eintrittspupille liegt im Unendlichen, hat also keinen Durchmesser</translation></message>
<message><source>an object at ∞ has no height</source><translation>ein Objekt im Unendlichen hat keine Höhe</translation></message>
<message><source>the object height is {value} mm, but an object at ∞ has no height</source><translation>die Objekthöhe ist {value} mm, aber ein Objekt im Unendlichen hat keine Höhe</translation></message>
<message><source>give Depth as well, or the field as an angle or an image height</source><translation>auch den Objektabstand angeben oder das Feld als Winkel oder Bildhöhe</translation></message>
<message><source>write ∞ for a plane</source><translation>∞ für eine Ebene schreiben</translation></message>
<message><source>write a number that is not 0, ∞ for a plane</source><translation>eine Zahl schreiben, die nicht 0 ist, ∞ für eine Ebene</translation></message>
<message><source>write the distance to the next surface as a number</source><translation>den Abstand zur nächsten Fläche als Zahl schreiben</translation></message>
<message><source>write a positive number</source><translation>eine positive Zahl schreiben</translation></message>
<message><source>write a finite number</source><translation>eine endliche Zahl schreiben</translation></message>
<message><source>write an angle in degrees below 90</source><translation>einen Winkel in Grad unter 90 schreiben</translation></message>
<message><source>write a wavelength in nanometres, 50 to 50000</source><translation>eine Wellenlänge in Nanometern schreiben, 50 bis 50000</translation></message>
<message><source>{name} is {found}; list some of {names}, each once and in this order</source><translation>{name} ist {found}; einige von {names} nennen, jedes einmal und in dieser Reihenfolge</translation></message>
<message><source>{name} is {found}; give true or false</source><translation>{name} ist {found}; true oder false angeben</translation></message>
<message><source>{name} is {found}; give a text</source><translation>{name} ist {found}; einen Text angeben</translation></message>
<message><source>{name} is {found}; give a whole number</source><translation>{name} ist {found}; eine ganze Zahl angeben</translation></message>
<message><source>{key} is {found}; write a text in quotation marks</source><translation>{key} ist {found}; einen Text in Anführungszeichen schreiben</translation></message>
<message><source>{key} is {found}; write a list of numbers as in [1.0, 2.0]</source><translation>{key} ist {found}; eine Liste von Zahlen schreiben wie [1.0, 2.0]</translation></message>
<message><source>{key} is {found}; write a whole number</source><translation>{key} ist {found}; eine ganze Zahl schreiben</translation></message>
<message><source>aperture is {found}; write [aperture] and one of {names}</source><translation>aperture ist {found}; [aperture] und eines von {names} schreiben</translation></message>
<message><source>glass is {found}; write a name such as "SCHOTT N-BK7", an index, or nd and vd</source><translation>glass ist {found}; einen Namen wie "SCHOTT N-BK7", einen Index oder nd und vd schreiben</translation></message>
<message><source>glass is {found}; write { nd = 1.5168, vd = 64.17 } or { wavelengths_um = […], n = […] }</source><translation>glass ist {found}; { nd = 1.5168, vd = 64.17 } oder { wavelengths_um = […], n = […] } schreiben</translation></message>
<message><source>"{line}" is no entry of the header; give {names}</source><translation>"{line}" ist kein Eintrag des Kopfes; {names} angeben</translation></message>
<message><source>"{name}:" is no entry of a step here; give {names}</source><translation>"{name}:" ist hier kein Eintrag eines Schritts; {names} angeben</translation></message>
<message><source>the range to play is {values}; give where it begins and where it ends</source><translation>der Bereich zum Abspielen ist {values}; angeben, wo er beginnt und wo er endet</translation></message>
<message><source>the blur is too large for a reference here</source><translation>die Unschärfe ist hier zu groß für eine Referenz</translation></message>
<message><source>bring focus and source together to see waves</source><translation>Fokus und Quelle zusammenbringen, um Wellen zu sehen</translation></message>
<message><source>stop down or go nearer the axis to see waves</source><translation>abblenden oder näher an die Achse gehen, um Wellen zu sehen</translation></message>
<message><source>glass "{name}": refractiveindex.info has no such page; check shelf/book/page</source><translation>Glas "{name}": refractiveindex.info hat keine solche Seite; shelf/book/page prüfen</translation></message>
<message><source>this is the older surfaceArray form, convert it in ISET</source><translation>das ist die ältere Form surfaceArray, in ISET umwandeln</translation></message>
<message><source>a lens lists its "surfaces"</source><translation>ein Objektiv listet seine "surfaces"</translation></message>
<message><source>glass has the keys {names}; write {known}</source><translation>glass hat die Schlüssel {names}; {known} schreiben</translation></message>
<message><source>range_um of {name} is {limits}; write the shortest and the longest wavelength</source><translation>range_um von {name} ist {limits}; die kürzeste und die längste Wellenlänge schreiben</translation></message>
<message><source>every chief ray meets the sensor on the axis, so it holds no picture</source><translation>jeder Hauptstrahl trifft den Sensor auf der Achse, also enthält er kein Bild</translation></message>
<message><source>move the stop</source><translation>die Blende verschieben</translation></message>
<message><source>{count} wavelengths for a colour PSF</source><translation>{count} Wellenlängen für eine farbige PSF</translation></message>
<message><source>give a whole number from 1 to {most}</source><translation>eine ganze Zahl von 1 bis {most} angeben</translation></message>
<message><source>give a whole number from 1</source><translation>eine ganze Zahl ab 1 angeben</translation></message>
<message><source>a PSF of {count} samples</source><translation>eine PSF aus {count} Proben</translation></message>
<message><source>{count} PSF samples exceed {most}</source><translation>{count} PSF-Proben sind mehr als {most}</translation></message>
<message><source>ask for fewer pixels or fewer PSFs</source><translation>weniger Pixel oder weniger PSFs verlangen</translation></message>
<message><source>a pixel of {pitch} µm</source><translation>ein Pixel von {pitch} µm</translation></message>
<message><source>a stack of no PSFs has no width of its own</source><translation>ein Stapel ohne PSFs hat keine eigene Breite</translation></message>
<message><source>give the pixel in µm</source><translation>das Pixel in µm angeben</translation></message>
<message><source>quality "{name}" is unknown</source><translation>die Güte "{name}" ist unbekannt</translation></message>
<message><source>sampling "{name}" is unknown</source><translation>die Abtastung "{name}" ist unbekannt</translation></message>
<message><source>{what} is {value}; give a positive number</source><translation>{what} ist {value}; eine positive Zahl angeben</translation></message>
<message><source>{what} is {value}; give a positive number, or ∞</source><translation>{what} ist {value}; eine positive Zahl oder ∞ angeben</translation></message>
<message><source>{what} is {value}; give a finite number</source><translation>{what} ist {value}; eine endliche Zahl angeben</translation></message>
<message><source>the spectrum "{kind}" takes no number, not {number}; write {words}</source><translation>das Spektrum "{kind}" hat keine Zahl, auch nicht {number}; {words} schreiben</translation></message>
<message><source>the spectrum "{text}" holds "{rest}", which is no list of numbers; write {words}</source><translation>das Spektrum "{text}" enthält "{rest}", was keine Liste von Zahlen ist; {words} schreiben</translation></message>
<message><source>spectral lines have no power per wavelength</source><translation>Spektrallinien haben keine Leistung je Wellenlänge</translation></message>
<message><source>take their wavelengths one by one</source><translation>ihre Wellenlängen einzeln nehmen</translation></message>
<message><source>no fit has {count} numbers</source><translation>keine Anpassung hat {count} Zahlen</translation></message>
<message><source>the ending "{ending}" is unknown</source><translation>die Endung "{ending}" ist unbekannt</translation></message>
<message><source>no PSF can be read from the ending "{ending}"</source><translation>aus der Endung "{ending}" lässt sich keine PSF lesen</translation></message>
<message><source>one file holds one PSF, this stack has shape {shape}</source><translation>eine Datei enthält eine PSF, dieser Stapel hat die Form {shape}</translation></message>
<message><source>write them singly</source><translation>einzeln schreiben</translation></message>
<message><source>a chart of {columns} × {rows} pixels</source><translation>eine Tafel von {columns} × {rows} Pixeln</translation></message>
<message><source>give {low} to {high} each way</source><translation>{low} bis {high} je Richtung angeben</translation></message>
<message><source>the noise is {value}</source><translation>das Rauschen ist {value}</translation></message>
<message><source>give the standard deviation of the picture's noise, above 0</source><translation>die Standardabweichung des Bildrauschens angeben, über 0</translation></message>
<message><source>{count} rounds of Richardson–Lucy</source><translation>{count} Runden Richardson–Lucy</translation></message>
<message><source>picture encoding "{name}" is unknown</source><translation>die Bildkodierung "{name}" ist unbekannt</translation></message>
<message><source>an energy fraction of {value}</source><translation>ein Energieanteil von {value}</translation></message>
<message><source>a profile through "{place}" is unknown</source><translation>ein Profil durch "{place}" ist unbekannt</translation></message>
<message><source>a toroid that is not round</source><translation>ein Toroid, das nicht rund ist</translation></message>
<message><source>a surface that is not round</source><translation>eine Fläche, die nicht rund ist</translation></message>
<message><source>a grating that diffracts</source><translation>ein beugendes Gitter</translation></message>
<message><source>a diffractive surface</source><translation>eine diffraktive Fläche</translation></message>
<message><source>an ideal lens without a prescription</source><translation>eine ideale Linse ohne Rezept</translation></message>
<message><source>a non-sequential part</source><translation>ein nicht sequentieller Teil</translation></message>
<message><source>a black box that hides its surfaces</source><translation>eine Black Box, die ihre Flächen verbirgt</translation></message>
<message><source>an asphere with odd powers</source><translation>eine Asphäre mit ungeraden Potenzen</translation></message>
<message><source>this is a database of PSFs, not a lens or a state</source><translation>das ist eine Datenbank von PSFs, kein Objektiv und kein Zustand</translation></message>
<message><source>use it with p2sf psf, or open its lens</source><translation>mit p2sf psf benutzen oder ihr Objektiv öffnen</translation></message>
<message><source>there is no readable state in this picture or PSF</source><translation>in diesem Bild oder dieser PSF ist kein lesbarer Zustand</translation></message>
<message><source>open a snapshot, written by the window with Ctrl+E, or with the Image panel open drop a photo</source><translation>einen Schnappschuss öffnen, den das Fenster mit Strg+E schreibt, oder bei offenem Feld Bild ein Foto ablegen</translation></message>
<message><source>an asphere in Forbes's polynomials</source><translation>eine Asphäre in Forbes-Polynomen</translation></message>
<message><source>an extended odd asphere</source><translation>eine erweiterte ungerade Asphäre</translation></message>
<message><source>an extended asphere</source><translation>eine erweiterte Asphäre</translation></message>
<message><source>a Fresnel surface</source><translation>eine Fresnel-Fläche</translation></message>
<message><source>a gradient index</source><translation>ein Gradientenindex</translation></message>
<message><source>the root of the sphere on its other side</source><translation>die Lösung auf der anderen Seite der Kugel</translation></message>
<message><source>is stopped by the rim of surface {number}</source><translation>wird vom Rand der Fläche {number} aufgehalten</translation></message>
<message><source>meets the asphere on surface {number} where no safe intersection was found</source><translation>trifft die Asphäre auf Fläche {number}, wo kein sicherer Schnittpunkt zu finden war</translation></message>
<message><source>could not be aimed at its place in the stop, surface {number}</source><translation>ließ sich nicht auf seinen Ort in der Blende richten, Fläche {number}</translation></message>
<message><source>{what} is {value}; give a positive number, ∞ allowed</source><translation>{what} ist {value}; eine positive Zahl angeben, ∞ erlaubt</translation></message>
<message><source>{what} is {value}; give a positive finite number</source><translation>{what} ist {value}; eine positive endliche Zahl angeben</translation></message>
<message><source>a colour PSF has no ending "{ending}"</source><translation>eine farbige PSF hat nicht die Endung "{ending}"</translation></message>
<message><source>{key} is {found}; the number {number} without quotation marks</source><translation>{key} ist {found}; die Zahl {number} ohne Anführungszeichen</translation></message>
<message><source>glass {name} of {file} has nd {nd} by its coefficients and {listed} by its name line</source><translation>das Glas {name} aus {file} hat nd {nd} nach seinen Koeffizienten und {listed} nach seiner Namenszeile</translation></message>
<message><source>radius {number} differs from the lens data's</source><translation>der Radius {number} weicht von dem der Linsendaten ab</translation></message>
<message><source>{surface}: radius {number} differs from the lens data's</source><translation>{surface}: der Radius {number} weicht von dem der Linsendaten ab</translation></message>
<message><source>choose "settled" or "preview"</source><translation>"settled" oder "preview" wählen</translation></message>
<message><source>choose "mdft" or "fft"</source><translation>"mdft" oder "fft" wählen</translation></message>
<message><source>choose "file" or "auto"</source><translation>"file" oder "auto" wählen</translation></message>
<message><source>choose file or auto</source><translation>file oder auto wählen</translation></message>
<message><source>sensor shift {shift} µm: share of the perfect peak</source><translation>Sensorversatz {shift} µm: Anteil der perfekten Spitze</translation></message>
<message><source>at ({x}, {y}) of the corner: share of the peak</source><translation>bei ({x}, {y}) der Ecke: Anteil der Spitze</translation></message>
<message><source>sagittal S, third order</source><translation>sagittal S, dritte Ordnung</translation></message>
<message><source>tangential T, third order</source><translation>tangential T, dritte Ordnung</translation></message>
<message><source>distortion, third order</source><translation>Verzeichnung, dritte Ordnung</translation></message>
<message><source>1/depth, 1/mm</source><translation>1/Abstand, 1/mm</translation></message>
<message><source>surfaces in the order of the light</source><translation>Flächen in der Reihenfolge des Lichts</translation></message>
<message><source>z, mm</source><translation>z, mm</translation></message>
<message><source>y, mm</source><translation>y, mm</translation></message>
<message><source>Paraxial image of this depth, from the last vertex; from the principal points 1/s′ = 1/f′ − 1/s.</source><translation>Paraxiales Bild dieses Abstands, vom letzten Scheitel; von den Hauptpunkten aus 1/s′ = 1/f′ − 1/s.</translation></message>
<message><source>Where the sensor stands, from the last vertex: in the image of the focus distance, shifted by Δz.</source><translation>Wo der Sensor steht, vom letzten Scheitel: im Bild des eingestellten Abstands, um Δz verschoben.</translation></message>
<message><source>The surface whose rim limits the light: the least |rim/y| on the way of the marginal ray, or the file's choice.</source><translation>Die Fläche, deren Rand das Licht begrenzt: das kleinste |Rand/y| auf dem Weg des Randstrahls, oder wie es die Datei sagt.</translation></message>
<message><source>The stop seen from the object: its diameter D = f′/N for a far object, its place from the first vertex.</source><translation>Die Blende vom Objekt aus gesehen: ihr Durchmesser D = f′/N für ein fernes Objekt, ihr Ort vom ersten Scheitel.</translation></message>
<message><source>The stop seen from the sensor: its diameter, and its place from the last vertex.</source><translation>Die Blende vom Sensor aus gesehen: ihr Durchmesser und ihr Ort vom letzten Scheitel.</translation></message>
<message><source>Peak of the PSF over that of the same pupil with W = 0; near 1 it is about exp(−(2πσ)²), σ the RMS of W.</source><translation>Spitze der PSF über der derselben Pupille mit W = 0; nahe 1 etwa exp(−(2πσ)²), σ der RMS von W.</translation></message>
<message><source>Rear focal point, where light from a far axial point meets, from the last vertex: f′·A.</source><translation>Bildseitiger Brennpunkt, wo sich das Licht eines fernen Achspunkts trifft, vom letzten Scheitel: f′·A.</translation></message>
<message><source>Front focal point, whose light leaves as a parallel beam, from the first vertex: D/C.</source><translation>Objektseitiger Brennpunkt, dessen Licht als paralleles Bündel austritt, vom ersten Scheitel: D/C.</translation></message>
<message><source>Front principal plane, imaged onto H′ at magnification 1; from the first vertex.</source><translation>Objektseitige Hauptebene, mit Maßstab 1 auf H′ abgebildet; vom ersten Scheitel.</translation></message>
<message><source>Rear principal plane, from which f′ is measured to F′; from the last vertex.</source><translation>Bildseitige Hauptebene, von der f′ bis F′ zählt; vom letzten Scheitel.</translation></message>
<message><source>A ray aimed at N leaves from N′ in its old direction; from the first vertex.</source><translation>Ein auf N gerichteter Strahl tritt aus N′ in alter Richtung aus; vom ersten Scheitel.</translation></message>
<message><source>A ray aimed at N leaves from N′ in its old direction; from the last vertex.</source><translation>Ein auf N gerichteter Strahl tritt aus N′ in alter Richtung aus; vom letzten Scheitel.</translation></message>
<message><source>Length of the lens with its air: from the first vertex to the sensor.</source><translation>Länge des Objektivs mit seiner Luft: vom ersten Scheitel bis zum Sensor.</translation></message>
<message><source>Figures</source><translation>Zahlen</translation></message>
<message><source>Text of the lesson</source><translation>Text der Lektion</translation></message>
<message><source>Why this many PSFs</source><translation>Warum so viele PSFs</translation></message>
<message><source>Drag the line or click, or use the left and right arrow keys: the sensor follows.</source><translation>Die Linie ziehen, klicken oder die Pfeiltasten links und rechts: der Sensor folgt.</translation></message>
<message><source>Panels</source><translation>Ansichten</translation></message>
<message><source>seidel: six coefficients are enough, predicted R² ≥ {r}</source><translation>seidel: sechs Koeffizienten genügen, vorhergesagt R² ≥ {r}</translation></message>
<message><source>{shift} µm over the spectrum</source><translation>{shift} µm über das Spektrum</translation></message>
<message><source>Front-stop landscape singlet</source><translation>Landschaftslinse mit vorderer Blende</translation></message>
<message><source>sharpened</source><translation>geschärft</translation></message>
<message><source>sharpened wrongly</source><translation>falsch geschärft</translation></message>
<message><source>barrel {part} at {field}</source><translation>Tonne {part} bei {field}</translation></message>
<message><source>pincushion {part} at {field}</source><translation>Kissen {part} bei {field}</translation></message>
<message><source>A − B {part} at {field}</source><translation>A − B {part} bei {field}</translation></message>
<message><source>drawn {times} times</source><translation>{times}fach gezeichnet</translation></message>
<message><source>as it is</source><translation>wie es ist</translation></message>
<message><source>read</source><translation>gelesen</translation></message>
<message><source>substituted</source><translation>ersetzt</translation></message>
<message><source>ignored, without effect on the picture</source><translation>übergangen, ohne Wirkung auf das Bild</translation></message>
<message><source>taken differently from the file</source><translation>anders genommen als in der Datei</translation></message>
<message><source>refused</source><translation>abgelehnt</translation></message>
<message><source>with consent: {title}</source><translation>mit Zustimmung: {title}</translation></message>
<message><source>a lens file of this program, exactly as written</source><translation>eine Objektivdatei dieses Programms, genau wie geschrieben</translation></message>
<message><source>edited since</source><translation>seither geändert</translation></message>
<message><source>{path} is not on this computer; the saved state carries the lens itself</source><translation>{path} ist nicht auf diesem Rechner; der gespeicherte Zustand enthält das Objektiv selbst</translation></message>
<message><source>surface {number}, line {count}: {why}</source><translation>Fläche {number}, Zeile {count}: {why}</translation></message>
<message><source>glass catalogue {path} with {count} glasses is at hand</source><translation>der Glaskatalog {path} mit {count} Gläsern liegt bei</translation></message>
<message><source>glass {name} is not known by name</source><translation>Glas {name} ist dem Namen nach unbekannt</translation></message>
<message><source>its nd {index} and vd {abbe} of the same row are taken</source><translation>nd {index} und vd {abbe} derselben Zeile gelten</translation></message>
<message><source>{count} surfaces, stop on surface {number}, {aperture}; {waves} nm; fields {angles}°</source><translation>{count} Flächen, Blende auf Fläche {number}, {aperture}; {waves} nm; Felder {angles}°</translation></message>
<message><source>f number {value}</source><translation>Blendenzahl {value}</translation></message>
<message><source>entrance pupil diameter {value} mm</source><translation>Durchmesser der Eintrittspupille {value} mm</translation></message>
<message><source>stop semi diameter {value} mm</source><translation>Halbmesser der Blende {value} mm</translation></message>
<message><source>the file holds several positions (zoom or focus)</source><translation>die Datei enthält mehrere Stellungen (Zoom oder Fokus)</translation></message>
<message><source>the first column is read</source><translation>die erste Spalte wird gelesen</translation></message>
<message><source>titles, sessions and computing settings</source><translation>Titel, Sitzungen und Recheneinstellungen</translation></message>
<message><source>solves and pickups, whose stored values are read</source><translation>Löse- und Übernahmevorschriften, deren gespeicherte Werte gelesen werden</translation></message>
<message><source>computing settings</source><translation>Recheneinstellungen</translation></message>
<message><source>variables, pickups and solves, whose stored values are read</source><translation>Variable, Übernahme- und Lösevorschriften, deren gespeicherte Werte gelesen werden</translation></message>
<message><source>tolerances and merit function</source><translation>Toleranzen und Gütefunktion</translation></message>
<message><source>the fourth column as the rim's diameter</source><translation>die vierte Spalte als Durchmesser des Rands</translation></message>
<message><source>the stop, surface {number}, is open to its rim, semi-diameter {value} mm</source><translation>die Blende, Fläche {number}, ist bis zum Rand offen, Halbmesser {value} mm</translation></message>
<message><source>the file does not say where the sensor is</source><translation>die Datei sagt nicht, wo der Sensor steht</translation></message>
<message><source>it is put at the paraxial focus for infinity</source><translation>er kommt in den paraxialen Fokus für unendlich</translation></message>
<message><source>private glass {name} as a table of {count} indices, straight lines between them</source><translation>eigenes Glas {name} als Tabelle von {count} Indizes, dazwischen Geraden</translation></message>
<message><source>fields given as {kind} are kept as angles at the entrance pupil</source><translation>als {kind} gegebene Felder werden als Winkel an der Eintrittspupille geführt</translation></message>
<message><source>image heights</source><translation>Bildhöhen</translation></message>
<message><source>object heights</source><translation>Objekthöhen</translation></message>
<message><source>lengths converted to mm from units of {value} mm</source><translation>Längen in mm umgerechnet aus Einheiten von {value} mm</translation></message>
<message><source>the file's object is at {value} mm</source><translation>das Objekt der Datei liegt bei {value} mm</translation></message>
<message><source>ask for this depth to see the file's image</source><translation>mit diesem Objektabstand entsteht das Bild der Datei</translation></message>
<message><source>a radius of 0 with an index is a plane</source><translation>ein Radius 0 mit einem Index ist eine Ebene</translation></message>
</context>
</TS>
