<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
<name>p2sf</name>
<message><source>spherical waves from the exit pupil, since plane ones may leave 1 − R² = {error:.1e}</source><translation>Kugelwellen aus der Austrittspupille, da ebene 1 − R² = {error:.1e} übrig lassen können</translation></message>
<message><source>this blur takes more than some seconds to the accuracy asked for, 1 − R² ≤ {asked:.1e}; this picture of {method} may be wrong throughout; stop down, refocus, or choose a method by its name</source><translation>diese Unschärfe braucht mehr als einige Sekunden für die verlangte Genauigkeit, 1 − R² ≤ {asked:.1e}; dieses Bild von {method} kann ganz falsch sein; abblenden, neu scharfstellen oder ein Verfahren beim Namen wählen</translation></message>
<message><source>this blur takes more than some seconds to the accuracy asked for, 1 − R² ≤ {asked:.1e}; {method} keeps 1 − R² ≤ {error:.1e}, a relative L2 error of {l2:.1e}</source><translation>diese Unschärfe braucht mehr als einige Sekunden für die verlangte Genauigkeit, 1 − R² ≤ {asked:.1e}; {method} hält 1 − R² ≤ {error:.1e}, einen relativen L2-Fehler von {l2:.1e}</translation></message>
<message><source>Transparency</source><translation>Transparenz</translation></message>
<message><source>What is shown has the PSFs of one distance; show through the lens, or sharpened by its PSFs, to use depths</source><translation>Was gezeigt wird, hat die PSFs einer Entfernung; Entfernungen gelten durch das Objektiv und mit seinen PSFs geschärft</translation></message>
<message><source>the depth map holds depths that are not positive, {count} of them, the first {value:g} mm at row {row}, column {column} (from 0); give mm from the first vertex, inf allowed</source><translation>die Tiefenkarte enthält {count} Abstände, die nicht positiv sind, den ersten mit {value:g} mm in Zeile {row}, Spalte {column} (ab 0); mm vom ersten Scheitel angeben, inf erlaubt</translation></message>
<message><source>the picture has light of {least:g} at row {row}, column {column} (from 0), and below 0 in {count} values; light is 0 or more, so set these to 0 first</source><translation>das Bild hat in Zeile {row}, Spalte {column} (ab 0) Licht von {least:g}, insgesamt {count} Werte unter 0; Licht ist nie negativ, diese zuerst auf 0 setzen</translation></message>
<message><source>the picture holds values that are not finite, {count} of them, the first at row {row}, column {column} (from 0); replace them first</source><translation>das Bild enthält {count} Werte, die nicht endlich sind, den ersten in Zeile {row}, Spalte {column} (ab 0); diese zuerst ersetzen</translation></message>
<message><source>{error:.2g} allowed</source><translation>{error:.2g} erlaubt</translation></message>
<message><source>{parameter} begins at row {top} and column {left}, amid a block of the mosaic; give even numbers</source><translation>{parameter} beginnt in Zeile {top} und Spalte {left}, mitten in einem Block des Mosaiks; gerade Zahlen angeben</translation></message>
<message><source>{parameter} has the rows {top} to {bottom} and the columns {left} to {right}, but the picture {rows} rows and {columns} columns; give a part of it</source><translation>{parameter} hat die Zeilen {top} bis {bottom} und die Spalten {left} bis {right}, das Bild aber {rows} Zeilen und {columns} Spalten; einen Teil davon angeben</translation></message>
<message><source>{parameter} is {gaps}; give pairs of depths in mm between {near:g} mm and {far:g} mm, from near to far, of which none overlap</source><translation>{parameter} ist {gaps}; Paare von Tiefen in mm zwischen {near:g} mm und {far:g} mm angeben, von nah nach fern, von denen sich keine überlappen</translation></message>
<message><source>{parameter} is {given}; give four whole numbers: top, bottom, left, right</source><translation>{parameter} ist {given}; vier ganze Zahlen angeben: oben, unten, links, rechts</translation></message>
<message><source>{path} holds depths that are negative or no numbers, {count} of them, the first {value:g} at row {row}, column {column} (from 0); correct them</source><translation>{path} enthält {count} Entfernungen, die negativ oder keine Zahlen sind, die erste mit {value:g} in Zeile {row}, Spalte {column} (ab 0); berichtigen</translation></message>
<message><source>{path} holds values that are not finite, {count} of them, the first at row {row}, column {column} (from 0); replace them first</source><translation>{path} enthält {count} Werte, die nicht endlich sind, den ersten in Zeile {row}, Spalte {column} (ab 0); diese zuerst ersetzen</translation></message>
<message><source>{reason}; plane waves may miss 1 − R² = {error:.1e} here, and spherical ones would take too long</source><translation>{reason}; ebene Wellen können hier 1 − R² = {error:.1e} verfehlen, und Kugelwellen dauerten zu lange</translation></message>
<message><source>{rows} × {columns} places × {waves} wavelengths × {depths} depths</source><translation>{rows} × {columns} Orte × {waves} Wellenlängen × {depths} Entfernungen</translation></message>
<message><source>No maps of this lens</source><translation>Keine Karten dieses Objektivs</translation></message>
<message><source>Show the Cooke triplet</source><translation>Das Cooke-Triplett zeigen</translation></message>
<message><source>Undo brings this lens back</source><translation>Rückgängig holt dieses Objektiv zurück</translation></message>
<message><source>{share:.3g} % of the picture is transparent, which is left out: its colours count as opaque; put it on a background first if that is not meant</source><translation>{share:.3g} % des Bildes sind durchsichtig, was unbeachtet bleibt: Die Farben gelten als deckend; wenn das nicht gemeint ist, das Bild zuerst auf einen Hintergrund legen</translation></message>
<message><source>{why}. Drop a lens file on the window, or take one with maps.</source><translation>{why}. Eine Objektivdatei auf das Fenster ziehen oder ein Objektiv mit Karten nehmen.</translation></message>
<message><source>a picture of light up to {light:g} has noise of {noise:.2g} there; errors up to {part:.0%} of the noise are hidden by it, and larger than what was asked for</source><translation>ein Bild mit Licht bis {light:g} hat dort ein Rauschen von {noise:.2g}; Fehler bis zu {part:.0%} des Rauschens verschwinden darin, und das ist mehr als verlangt</translation></message>
<message><source>no chief ray lands {height:g} mm from the axis of the sensor, where the file has a field; state it as an angle</source><translation>kein Hauptstrahl trifft {height:g} mm von der Achse auf den Sensor, wo die Datei einen Feldpunkt hat; ihn als Winkel angeben</translation></message>
<message><source>no maps</source><translation>keine Karten</translation></message>
<message><source>A landscape that reaches from 1 m to 10 m: move the focus through it</source><translation>Eine Landschaft, die von 1 m bis 10 m reicht: die Schärfe hindurchziehen</translation></message>
<message><source>Choose a map of depths</source><translation>Eine Karte der Entfernungen wählen</translation></message>
<message><source>Choose another photo</source><translation>Ein anderes Foto wählen</translation></message>
<message><source>Drop a photo here</source><translation>Ein Foto hierher ziehen</translation></message>
<message><source>Farthest depth</source><translation>Größte Entfernung</translation></message>
<message><source>halos are those of one picture, not of layers; leave {parameter} out, or give one picture and its depths</source><translation>Lichthöfe gehören zu einem Bild, nicht zu Schichten; {parameter} weglassen oder ein Bild und seine Entfernungen angeben</translation></message>
<message><source>How far away the parts of the picture are: one distance, nearer towards the bottom, three steps to the right …</source><translation>Wie weit die Teile des Bildes entfernt sind: eine Entfernung, nach unten hin näher, drei Stufen nach rechts …</translation></message>
<message><source>Maps of depths (*.png *.tif *.tiff)</source><translation>Karten der Entfernungen (*.png *.tif *.tiff)</translation></message>
<message><source>Nearest depth</source><translation>Kleinste Entfernung</translation></message>
<message><source>RMS at most {error:.2g} of white, as expected from the response of its PSFs</source><translation>RMS höchstens {error:.2g} von Weiß, wie es die Übertragung seiner PSFs erwarten lässt</translation></message>
<message><source>What the numbers of the map mean</source><translation>Was die Zahlen der Karte bedeuten</translation></message>
<message><source>a map of depths means "{meaning}"; choose {choices}</source><translation>eine Karte der Entfernungen bedeutet „{meaning}“; wählen: {choices}</translation></message>
<message><source>error up to {percent} % of white</source><translation>Fehler bis {percent} % von Weiß</translation></message>
<message><source>far</source><translation>fern</translation></message>
<message><source>farthest depth of the photo</source><translation>größte Entfernung des Fotos</translation></message>
<message><source>near</source><translation>nah</translation></message>
<message><source>nearest depth of the photo</source><translation>kleinste Entfernung des Fotos</translation></message>
<message><source>nodes stand at equal steps of 1/distance, and none in {count} gaps</source><translation>die Knoten stehen in gleichen Schritten von 1/Abstand, und keine in {count} Lücken</translation></message>
<message><source>noise</source><translation>Rauschen</translation></message>
<message><source>the depth map holds {depth:g} mm, which lies in a gap of the scene; leave {parameter} out, or plan for the depths of this map</source><translation>die Tiefenkarte enthält {depth:g} mm, was in einer Lücke der Szene liegt; {parameter} weglassen oder für die Tiefen dieser Karte planen</translation></message>
<message><source>the map reaches from {near:g} mm to {far:g} mm; give positive depths, the near one first</source><translation>die Karte reicht von {near:g} mm bis {far:g} mm; positive Entfernungen angeben, die nahe zuerst</translation></message>
<message><source>{path} does not state how far away its depths are; save them as a PNG and give near and far</source><translation>{path} sagt nicht, wie groß seine Entfernungen sind; als PNG speichern und nah und fern angeben</translation></message>
<message><source>{path} has no depths of its own; choose a map of depths</source><translation>{path} hat keine eigenen Entfernungen; eine Karte der Entfernungen wählen</translation></message>
<message><source>{path} has the shape ({shape}); a map of depths has one grey channel</source><translation>{path} hat die Form ({shape}); eine Karte der Entfernungen hat einen grauen Kanal</translation></message>
<message><source>{path} holds no depth: all of it is 0; choose another map</source><translation>{path} enthält keine Entfernung: alles ist 0; eine andere Karte wählen</translation></message>
<message><source>{path} holds numbers up to {most:g}, between near and far they reach from 0 to 1; choose mm or m</source><translation>{path} enthält Zahlen bis {most:g}, zwischen nah und fern reichen sie von 0 bis 1; mm oder m wählen</translation></message>
<message><source>{path} is a HEIF that cannot be read ({why}); save it again</source><translation>{path} ist ein HEIF, das nicht gelesen werden kann ({why}); noch einmal speichern</translation></message>
<message><source>one distance</source><translation>eine Entfernung</translation></message>
<message><source>sloping</source><translation>geneigt</translation></message>
<message><source>the picture has light up to {most:g}, but the noise that the plan allows for is that of light up to {brightest:g}; plan with {parameter} {most:g}</source><translation>das Bild hat Licht bis {most:g}, doch der Plan rechnet mit dem Rauschen von Licht bis {brightest:g}; mit {parameter} {most:g} planen</translation></message>
<message><source>the pixels of a mosaic have different colours and cannot be joined; leave it out</source><translation>die Pixel eines Mosaiks haben verschiedene Farben und lassen sich nicht zusammenfassen; das Mosaik weglassen</translation></message>
<message><source>the scene has these depths alone</source><translation>die Szene hat nur diese Abstände</translation></message>
<message><source>three steps</source><translation>drei Stufen</translation></message>
<message><source>its own depths</source><translation>eigene Entfernungen</translation></message>
<message><source>white is near</source><translation>Weiß ist nah</translation></message>
<message><source>black is near</source><translation>Schwarz ist nah</translation></message>
<message><source>in mm</source><translation>in mm</translation></message>
<message><source>in m</source><translation>in m</translation></message>
<message><source>a layer has a depth that is not positive; give mm from the first vertex, inf allowed</source><translation>eine Schicht hat eine Entfernung, die nicht positiv ist; mm vom ersten Scheitel angeben, inf erlaubt</translation></message>
<message><source>alpha reaches from {low:g} to {high:g}; give the share of light that a layer hides, from 0 to 1</source><translation>Alpha reicht von {low:g} bis {high:g}; den Anteil des Lichts angeben, den eine Schicht verdeckt, von 0 bis 1</translation></message>
<message><source>Build a lens in Python</source><translation>Ein Objektiv in Python bauen</translation></message>
<message><source>Gallery</source><translation>Galerie</translation></message>
<message><source>Add a step for every step of undo of this lens, up to what is on screen</source><translation>Für jeden Schritt, den Rückgängig kennt, einen Schritt mit diesem Objektiv anfügen, bis zu dem, was zu sehen ist</translation></message>
<message><source>Add a step that shows what is on screen now</source><translation>Einen Schritt anfügen, der zeigt, was jetzt zu sehen ist</translation></message>
<message><source>Add the steps of undo</source><translation>Schritte von Rückgängig anfügen</translation></message>
<message><source>Add what is on screen</source><translation>Anfügen, was zu sehen ist</translation></message>
<message><source>Each step keeps what is on screen: go on in the window, and add the next step here. What you write is Markdown.</source><translation>Jeder Schritt behält, was zu sehen ist: im Fenster weitergehen und hier den nächsten Schritt anfügen. Geschrieben wird in Markdown.</translation></message>
<message><source>Field {field}</source><translation>Feld {field}</translation></message>
<message><source>Film of random builds…</source><translation>Film von zufällig gebauten Objektiven …</translation></message>
<message><source>Film of the sweep…</source><translation>Film des Durchlaufs …</translation></message>
<message><source>Find a command, a panel, a lens, a lesson or a preset</source><translation>Einen Befehl, eine Ansicht, ein Objektiv, eine Lektion oder ein Beispiel finden</translation></message>
<message><source>Heading</source><translation>Überschrift</translation></message>
<message><source>In one sentence</source><translation>In einem Satz</translation></message>
<message><source>Learn</source><translation>Lernen</translation></message>
<message><source>A photo through a lens</source><translation>Ein Foto durch ein Objektiv</translation></message>
<message><source>What a lens makes of a scene, near and far</source><translation>Was ein Objektiv aus einer Szene macht, nah und fern</translation></message>
<message><source>Open my lens</source><translation>Mein Objektiv öffnen</translation></message>
<message><source>First picture, and where to begin</source><translation>Erstes Bild, und wo es losgeht</translation></message>
<message><source>One star, as this lens shows it off its axis. Drag Field: at 0° the star is round.</source><translation>Ein Stern, wie ihn dieses Objektiv neben der Achse zeigt. Feld auf 0° ziehen: Er ist rund.</translation></message>
<message><source>Play the slider that moved last (Ctrl+Space; Space on a slider plays that one)</source><translation>Den zuletzt bewegten Regler abspielen (Strg+Leertaste; Leertaste auf einem Regler spielt diesen)</translation></message>
<message><source>R80 {most} µm</source><translation>R80 {most} µm</translation></message>
<message><source>R50 {half} µm; both of all light about its centroid; RMS of the rays {rms} µm; {method}</source><translation>R50 {half} µm; beide für alles Licht um seinen Schwerpunkt; RMS der Strahlen {rms} µm; {method}</translation></message>
<message><source>marginal</source><translation>Randstrahlen</translation></message>
<message><source>chief</source><translation>Hauptstrahl</translation></message>
<message><source>Focal length</source><translation>Brennweite</translation></message>
<message><source>y, µm (outwards)</source><translation>y, µm (nach außen)</translation></message>
<message><source>y, µm (inwards)</source><translation>y, µm (nach innen)</translation></message>
<message><source>A | B</source><translation>A | B</translation></message>
<message><source>PSF as NumPy (*.npz);;PSF as TIFF (*.tiff);;PSF as FITS (*.fits);;PSF as CSV (*.csv)</source><translation>PSF als NumPy (*.npz);;PSF als TIFF (*.tiff);;PSF als FITS (*.fits);;PSF als CSV (*.csv)</translation></message>
<message><source>Picture of the window (*.png)</source><translation>Bild des Fensters (*.png)</translation></message>
<message><source>Picture of the window…</source><translation>Bild des Fensters …</translation></message>
<message><source>PSF as data…</source><translation>PSF als Daten …</translation></message>
<message><source>Save a picture that opens as it is here (Ctrl+E), or data</source><translation>Ein Bild sichern, das sich so öffnet, wie es hier steht (Strg+E), oder Daten</translation></message>
<message><source>Snapshot: a picture with its state in it…</source><translation>Schnappschuss: ein Bild, mit seinem Zustand darin …</translation></message>
<message><source>Snapshot: PSF as data, with the state…</source><translation>Schnappschuss: PSF als Daten, mit Zustand …</translation></message>
<message><source>Lessons with pictures, three minutes each</source><translation>Lektionen mit Bildern, je drei Minuten</translation></message>
<message><source>List of lessons…</source><translation>Liste der Lektionen …</translation></message>
<message><source>Made on {date}</source><translation>Erstellt am {date}</translation></message>
<message><source>Make a lesson of this</source><translation>Daraus eine Lektion machen</translation></message>
<message><source>Make a lesson of this…</source><translation>Daraus eine Lektion machen …</translation></message>
<message><source>Mirrors</source><translation>Spiegel</translation></message>
<message><source>No lesson has these words; try fewer.</source><translation>Keine Lektion enthält diese Wörter; weniger versuchen.</translation></message>
<message><source>Phone</source><translation>Telefon</translation></message>
<message><source>Remove the chosen step</source><translation>Den gewählten Schritt entfernen</translation></message>
<message><source>Remove the step</source><translation>Schritt entfernen</translation></message>
<message><source>Restore it</source><translation>Wiederherstellen</translation></message>
<message><source>Save and open</source><translation>Speichern und öffnen</translation></message>
<message><source>Search titles and texts</source><translation>Titel und Texte durchsuchen</translation></message>
<message><source>sensor {name} is {count}; give a whole number from {low} to {most}</source><translation>{name} des Sensors ist {count}; eine ganze Zahl von {low} bis {most} angeben</translation></message>
<message><source>"{name}" is no name of a task; use small letters, digits and hyphens</source><translation>"{name}" ist kein Name einer Aufgabe; kleine Buchstaben, Ziffern und Bindestriche verwenden</translation></message>
<message><source>"{name}:" does not go with "{kind}:"</source><translation>"{name}:" passt nicht zu "{kind}:"</translation></message>
<message><source>"{text}" is no answer with its tolerance; write one such as {example}</source><translation>"{text}" ist keine Antwort mit Toleranz; eine wie {example} schreiben</translation></message>
<message><source>How sure are you?</source><translation>Wie sicher sind Sie?</translation></message>
<message><source>a guess</source><translation>geraten</translation></message>
<message><source>unsure</source><translation>unsicher</translation></message>
<message><source>rather sure</source><translation>eher sicher</translation></message>
<message><source>sure</source><translation>sicher</translation></message>
<message><source>choose an answer, a reason and how sure you are</source><translation>wählen Sie eine Antwort, einen Grund und wie sicher Sie sind</translation></message>
<message><source>Not yet: the answer is right, and its reason is not.</source><translation>Noch nicht: Die Antwort stimmt, ihr Grund nicht.</translation></message>
<message><source>Gain in each item of the concept check</source><translation>Gewinn bei jeder Frage der Verständnisprüfung</translation></message>
<message><source>Gain</source><translation>Gewinn</translation></message>
<message><source>You marked {marked}; it is {truth}.</source><translation>Markiert haben Sie {marked}; es sind {truth}.</translation></message>
<message><source>First click on the picture where you expect the ring to pass.</source><translation>Klicken Sie zuerst im Bild dorthin, wo Sie den Ring erwarten.</translation></message>
<message><source>First click on the picture at the height that you expect.</source><translation>Klicken Sie zuerst im Bild auf die Höhe, die Sie erwarten.</translation></message>
<message><source>"{form}" cannot be marked; mark one of {names}</source><translation>„{form}“ lässt sich nicht markieren; markieren Sie eines von {names}</translation></message>
<message><source>First answer the question of this page.</source><translation>Beantworten Sie zuerst die Frage dieser Seite.</translation></message>
<message><source>Page Down: vote</source><translation>Bild ab: Abstimmung</translation></message>
<message><source>Item</source><translation>Frage</translation></message>
<message><source>Students</source><translation>Personen</translation></message>
<message><source>Right before</source><translation>Vorher richtig</translation></message>
<message><source>Right after</source><translation>Nachher richtig</translation></message>
<message><source>Sure and wrong</source><translation>Sicher und falsch</translation></message>
<message><source>Not yet.</source><translation>Noch nicht.</translation></message>
<message><source>Not yet: a factor of two is wrong. Radius or diameter?</source><translation>Noch nicht: Ein Faktor zwei stimmt nicht. Radius oder Durchmesser?</translation></message>
<message><source>Not yet: that is too large.</source><translation>Noch nicht: Das ist zu groß.</translation></message>
<message><source>Not yet: that is too small.</source><translation>Noch nicht: Das ist zu klein.</translation></message>
<message><source>Not yet: the digits are right, and the power of ten is not. Check the unit.</source><translation>Noch nicht: Die Ziffern stimmen, die Zehnerpotenz nicht. Die Einheit prüfen.</translation></message>
<message><source>Not yet: the size is right, and the sign is not.</source><translation>Noch nicht: Der Betrag stimmt, das Vorzeichen nicht.</translation></message>
<message><source>Not yet: {measure} is {value} and has to be {bounds}.</source><translation>Noch nicht: {measure} ist {value}; verlangt ist {bounds}.</translation></message>
<message><source>Not yet: “{first}” does not come before “{second}”.</source><translation>Noch nicht: „{first}“ kommt nicht vor „{second}“.</translation></message>
<message><source>PSFs of the coarse picture</source><translation>Zahl der PSFs des groben Bildes</translation></message>
<message><source>Petzval focus behind the sensor</source><translation>Petzval-Fokus hinter dem Sensor</translation></message>
<message><source>RMS that six coefficients leave out</source><translation>RMS, den sechs Koeffizienten auslassen</translation></message>
<message><source>RMS wavefront error</source><translation>RMS der Wellenfront</translation></message>
<message><source>Right.</source><translation>Richtig.</translation></message>
<message><source>R² against the Huygens sum</source><translation>R² gegen die Huygens-Summe</translation></message>
<message><source>R² against the Huygens sum in the paper's window</source><translation>R² gegen die Huygens-Summe im Fenster der Veröffentlichung</translation></message>
<message><source>a choice has two options or more, and a star before the right one</source><translation>eine Auswahl hat zwei Antworten oder mehr, und einen Stern vor der richtigen</translation></message>
<message><source>a goal needs a way there; add a line such as solve: field_deg 10</source><translation>ein Ziel braucht einen Weg dorthin; eine Zeile wie solve: field_deg 10 anfügen</translation></message>
<message><source>a number</source><translation>eine Zahl</translation></message>
<message><source>a number in {unit}</source><translation>eine Zahl in {unit}</translation></message>
<message><source>a task asks for one thing; give one of {names}</source><translation>eine Aufgabe fragt nach einem; eines von {names} angeben</translation></message>
<message><source>a task has no question; give both ask: and tell:</source><translation>eine Aufgabe hat keine Frage; ask: und tell: angeben</translation></message>
<message><source>a task needs a name; add a line such as task: my-first-task</source><translation>eine Aufgabe braucht einen Namen; eine Zeile wie task: my-first-task anfügen</translation></message>
<message><source>a wrong answer needs a hint; write it behind {colons}</source><translation>eine falsche Antwort braucht einen Hinweis; ihn hinter {colons} schreiben</translation></message>
<message><source>a wrong order has the numbers of all items, such as 2 1 3</source><translation>eine falsche Reihenfolge hat die Nummern aller Einträge, etwa 2 1 3</translation></message>
<message><source>above {wanted}</source><translation>über {wanted}</translation></message>
<message><source>an f-number, such as f/8</source><translation>eine Blendenzahl, etwa f/8</translation></message>
<message><source>an order has two different items or more, separated by semicolons</source><translation>eine Reihenfolge hat zwei verschiedene Einträge oder mehr, durch Semikolons getrennt</translation></message>
<message><source>answer</source><translation>Antwort</translation></message>
<message><source>astigmatism W22</source><translation>Astigmatismus W22</translation></message>
<message><source>below {wanted}</source><translation>unter {wanted}</translation></message>
<message><source>brightest ring over the peak</source><translation>hellster Ring gegen das Maximum</translation></message>
<message><source>centroid of the light in y</source><translation>Schwerpunkt des Lichts in y</translation></message>
<message><source>choose one of the answers</source><translation>eine der Antworten wählen</translation></message>
<message><source>coma W31</source><translation>Koma W31</translation></message>
<message><source>defocus Wd</source><translation>Defokus Wd</translation></message>
<message><source>distortion W11</source><translation>Verzeichnung W11</translation></message>
<message><source>error of the database by the paper's table 1</source><translation>Fehler der Datenbank nach Tabelle 1 der Veröffentlichung</translation></message>
<message><source>error of the database with exact interpolation</source><translation>Fehler der Datenbank bei genauer Interpolation</translation></message>
<message><source>error of the database with linear interpolation</source><translation>Fehler der Datenbank bei linearer Interpolation</translation></message>
<message><source>field curvature W20</source><translation>Bildfeldwölbung W20</translation></message>
<message><source>focal length</source><translation>Brennweite</translation></message>
<message><source>focus of red behind that of blue</source><translation>Fokus für Rot hinter dem für Blau</translation></message>
<message><source>gain of sharpening</source><translation>Gewinn durch Schärfen</translation></message>
<message><source>image height</source><translation>Bildhöhe</translation></message>
<message><source>intensity in the centre over the peak</source><translation>Intensität in der Mitte gegen das Maximum</translation></message>
<message><source>it holds no results of the course</source><translation>sie enthält keine Ergebnisse des Kurses</translation></message>
<message><source>it is damaged</source><translation>sie ist beschädigt</translation></message>
<message><source>it was written by another version of the program</source><translation>eine andere Version des Programms hat sie geschrieben</translation></message>
<message><source>its entry {entry} is damaged</source><translation>ihr Eintrag {entry} ist beschädigt</translation></message>
<message><source>number of corners of the blur</source><translation>Zahl der Ecken des Flecks</translation></message>
<message><source>number of spikes</source><translation>Zahl der Strahlen des Sterns</translation></message>
<message><source>numbers that the method keeps</source><translation>Zahlen, die das Verfahren behält</translation></message>
<message><source>numerical aperture</source><translation>numerische Apertur</translation></message>
<message><source>put all items into an order</source><translation>alle Einträge in eine Reihenfolge bringen</translation></message>
<message><source>radius of 80 % of the light</source><translation>Radius für 80 % des Lichts</translation></message>
<message><source>radius of the Airy disc</source><translation>Radius des Airy-Scheibchens</translation></message>
<message><source>radius of the first dark ring</source><translation>Radius des ersten dunklen Rings</translation></message>
<message><source>rays that the method traces</source><translation>Strahlen, die das Verfahren rechnet</translation></message>
<message><source>sagittal contrast at 50/mm</source><translation>sagittaler Kontrast bei 50/mm</translation></message>
<message><source>sagittal focus behind the sensor</source><translation>sagittaler Fokus hinter dem Sensor</translation></message>
<message><source>sagittal focus of real rays behind the sensor</source><translation>sagittaler Fokus wirklicher Strahlen hinter dem Sensor</translation></message>
<message><source>spherical aberration W40</source><translation>Öffnungsfehler W40</translation></message>
<message><source>spikes over the gaps between them</source><translation>Strahlen des Sterns gegen die Lücken dazwischen</translation></message>
<message><source>spread of the light in x</source><translation>Streuung des Lichts in x</translation></message>
<message><source>spread of the light in y</source><translation>Streuung des Lichts in y</translation></message>
<message><source>surface of the stop</source><translation>Fläche der Blende</translation></message>
<message><source>tangential contrast at 50/mm</source><translation>tangentialer Kontrast bei 50/mm</translation></message>
<message><source>tangential focus behind the sensor</source><translation>tangentialer Fokus hinter dem Sensor</translation></message>
<message><source>tangential focus of real rays behind the sensor</source><translation>tangentialer Fokus wirklicher Strahlen hinter dem Sensor</translation></message>
<message><source>the answer "{text}" is too large; write a number such as 12.5</source><translation>die Antwort "{text}" ist zu groß; eine Zahl wie 12,5 schreiben</translation></message>
<message><source>the answer has the unit {unit}; write the wrong one in it</source><translation>die Antwort hat die Einheit {unit}; die falsche in ihr schreiben</translation></message>
<message><source>the task has other options or hints than its original; say each in its place</source><translation>die Aufgabe hat andere Antworten oder Hinweise als ihr Original; jeden an seiner Stelle sagen</translation></message>
<message><source>the task of this step is "{wanted}"; name the same</source><translation>die Aufgabe dieses Schritts heißt "{wanted}"; dieselbe nennen</translation></message>
<message><source>there are {layers} layers and depths of shape ({shape}); give the depth of each layer, mm</source><translation>es gibt {layers} Schichten und Entfernungen der Form ({shape}); die Entfernung jeder Schicht in mm angeben</translation></message>
<message><source>{given} numbers are given, {count} are asked for</source><translation>{given} Zahlen sind angegeben, {count} gefragt</translation></message>
<message><source>{measure} has the unit {unit}; leave the unit out, and ask for a number in it</source><translation>{measure} hat die Einheit {unit}; die Einheit weglassen und nach einer Zahl in ihr fragen</translation></message>
<message><source>{path} cannot be read: {why}</source><translation>{path} kann nicht gelesen werden: {why}</translation></message>
<message><source>{path} holds no files of results (.json)</source><translation>{path} enthält keine Ergebnisdateien (.json)</translation></message>
<message><source>{path} is no folder; choose the one that holds the files of results</source><translation>{path} ist kein Ordner; den mit den Ergebnisdateien wählen</translation></message>
<message><source>Not yet: this is not the lens of the task. Set the task up again.</source><translation>Noch nicht: Das ist nicht das Objektiv der Aufgabe. Die Aufgabe neu einstellen.</translation></message>
<message><source>Not yet: waves were added by hand. Set the task up again.</source><translation>Noch nicht: Es wurden Wellen von Hand addiert. Die Aufgabe neu einstellen.</translation></message>
<message><source>Not yet: the lens was misaligned or aligned. Set the task up again.</source><translation>Noch nicht: Das Objektiv wurde dejustiert oder justiert. Die Aufgabe neu einstellen.</translation></message>
<message><source>Another version of the course: its tasks may differ</source><translation>Eine andere Version des Kurses: Ihre Aufgaben können andere sein</translation></message>
<message><source>Answer</source><translation>Antwort</translation></message>
<message><source>Back to the lecture</source><translation>Zurück zur Vorlesung</translation></message>
<message><source>Check</source><translation>Prüfen</translation></message>
<message><source>Check the answer (Enter)</source><translation>Die Antwort prüfen (Eingabe)</translation></message>
<message><source>Course</source><translation>Kurs</translation></message>
<message><source>Course…</source><translation>Kurs …</translation></message>
<message><source>Down</source><translation>Nach unten</translation></message>
<message><source>End</source><translation>Ende</translation></message>
<message><source>Folder with the files of results</source><translation>Ordner mit den Ergebnisdateien</translation></message>
<message><source>Hint {number} of {count}</source><translation>Hinweis {number} von {count}</translation></message>
<message><source>Items to be put in order</source><translation>Einträge, die zu ordnen sind</translation></message>
<message><source>Lessons of this lecture: {links}</source><translation>Lektionen dieser Vorlesung: {links}</translation></message>
<message><source>Make a lesson with questions of what is on screen</source><translation>Aus dem, was zu sehen ist, eine Lektion mit Fragen machen</translation></message>
<message><source>Make your own…</source><translation>Selbst eine machen …</translation></message>
<message><source>Move the chosen item down</source><translation>Den gewählten Eintrag nach unten schieben</translation></message>
<message><source>Move the chosen item up</source><translation>Den gewählten Eintrag nach oben schieben</translation></message>
<message><source>Next lecture</source><translation>Nächste Vorlesung</translation></message>
<message><source>Open a folder of such files as a table</source><translation>Einen Ordner solcher Dateien als Tabelle öffnen</translation></message>
<message><source>Results of a class</source><translation>Ergebnisse eines Kurses</translation></message>
<message><source>Results of a class…</source><translation>Ergebnisse eines Kurses …</translation></message>
<message><source>Right, at attempt {number}.</source><translation>Richtig, beim {number}. Versuch.</translation></message>
<message><source>Save as CSV…</source><translation>Als CSV speichern …</translation></message>
<message><source>Save my results of the course…</source><translation>Meine Ergebnisse des Kurses speichern …</translation></message>
<message><source>Save my results…</source><translation>Meine Ergebnisse speichern …</translation></message>
<message><source>Set lens and sliders as the task begins</source><translation>Objektiv und Regler so einstellen, wie die Aufgabe beginnt</translation></message>
<message><source>Set up again</source><translation>Neu einstellen</translation></message>
<message><source>Show the next hint; the file of results counts them</source><translation>Den nächsten Hinweis zeigen; die Ergebnisdatei zählt sie</translation></message>
<message><source>Show the solution</source><translation>Lösung zeigen</translation></message>
<message><source>There are no answers yet; work through a lecture first</source><translation>Noch gibt es keine Antworten; zuerst eine Vorlesung durcharbeiten</translation></message>
<message><source>Up</source><translation>Nach oben</translation></message>
<message><source>Work through the lectures alone, or give them with F5. Answers are kept on this computer, and sent nowhere.</source><translation>Zum Durcharbeiten, oder zum Halten mit F5. Antworten bleiben auf diesem Rechner und werden nirgendwohin geschickt.</translation></message>
<message><source>Write the table for a spreadsheet: attempts, hints, time and last answer of each task</source><translation>Die Tabelle für eine Tabellenkalkulation schreiben: Versuche, Hinweise, Zeit und letzte Antwort jeder Aufgabe</translation></message>
<message><source>Write what you answered to a file for your lecturer</source><translation>Die eigenen Antworten in eine Datei für die Lehrenden schreiben</translation></message>
<message><source>Your answer is noted.</source><translation>Die Antwort ist notiert.</translation></message>
<message><source>Your name, as your lecturer knows it</source><translation>Ihr Name, wie die Lehrenden ihn kennen</translation></message>
<message><source>{count} of {all} questions answered</source><translation>{count} von {all} Fragen beantwortet</translation></message>
<message><source>{count} of {all} tasks right</source><translation>{count} von {all} Aufgaben richtig</translation></message>
<message><source>{count} points have as many sources; ask one of them</source><translation>{count} Punkte haben ebenso viele Quellen; fragen Sie einen von ihnen</translation></message>
<message><source>{count} students</source><translation>{count} Studierende</translation></message>
<message><source>{count} tried it; wrong at first: {wrong}</source><translation>{count} haben sie versucht; zuerst falsch: {wrong}</translation></message>
<message><source>{path} cannot be written</source><translation>{path} kann nicht geschrieben werden</translation></message>
<message><source>✓ first time · ✓ 3 third attempt · ✗ 2 not in two · ◌ solution shown · under a task: share right</source><translation>✓ auf Anhieb · ✓ 3 beim dritten Versuch · ✗ 2 nicht in zweien · ◌ Lösung gezeigt · unter einer Aufgabe: Anteil richtig</translation></message>
<message><source>Lecture {number}: {title}</source><translation>Vorlesung {number}: {title}</translation></message>
<message><source>Click, or press T, to stop the countdown or let it go on</source><translation>Klicken, oder T drücken, hält den Countdown an oder lässt ihn weiterlaufen</translation></message>
<message><source>{count} seconds left</source><translation>noch {count} Sekunden</translation></message>
<message><source>Page Down goes on, Page Up back, a full stop blanks the screen, T stops the countdown, letters count votes</source><translation>Bild ab geht weiter, Bild auf zurück, ein Punkt macht den Schirm schwarz, T hält den Countdown an, Buchstaben zählen Stimmen</translation></message>
<message><source>A letter counts a raised hand, Backspace takes it back · counted: {count}</source><translation>Ein Buchstabe zählt eine gehobene Hand, die Rücktaste nimmt sie zurück · gezählt: {count}</translation></message>
<message><source>Discuss it with a neighbour, then vote again · counted: {count}</source><translation>Besprechen Sie es zu zweit, dann stimmen Sie noch einmal ab · gezählt: {count}</translation></message>
<message><source>Because … (Enter to type)</source><translation>Weil … (Eingabetaste, dann schreiben)</translation></message>
<message><source>Because …</source><translation>Weil …</translation></message>
<message><source>Say in one sentence why it is so; it is kept with your answers</source><translation>Sagen Sie in einem Satz, warum es so ist; er bleibt bei Ihren Antworten</translation></message>
<message><source>Because</source><translation>Weil</translation></message>
<message><source>Votes: {counts}</source><translation>Stimmen: {counts}</translation></message>
<message><source>Notes</source><translation>Notizen</translation></message>
<message><source>Next: {title}</source><translation>Danach: {title}</translation></message>
<message><source>Notes of the lesson in a window of their own</source><translation>Notizen zur Lektion in einem eigenen Fenster</translation></message>
<message><source>"{text}" has a bar or two colons, which part answers in a file; write it without</source><translation>"{text}" hat einen senkrechten Strich oder zwei Doppelpunkte, die in einer Datei Antworten trennen; ohne sie schreiben</translation></message>
<message><source>*{name}* is the name of nothing on screen; write emphasis as **{name}**</source><translation>*{name}* ist kein Name auf dem Schirm; Hervorhebungen als **{name}** schreiben</translation></message>
<message><source>A figure that the program measures</source><translation>Eine Größe, die das Programm misst</translation></message>
<message><source>A number</source><translation>Eine Zahl</translation></message>
<message><source>An order</source><translation>Eine Reihenfolge</translation></message>
<message><source>Answers, the right one first</source><translation>Antworten, die richtige zuerst</translation></message>
<message><source>Hint for it</source><translation>Hinweis dazu</translation></message>
<message><source>Hints</source><translation>Hinweise</translation></message>
<message><source>Insert a figure of the program…</source><translation>Eine Größe des Programms einsetzen …</translation></message>
<message><source>Kind</source><translation>Art</translation></message>
<message><source>Measure every claim, look for every control that is named, and solve every task</source><translation>Jede Behauptung messen, jeden genannten Regler suchen und jede Aufgabe lösen</translation></message>
<message><source>No question</source><translation>Keine Frage</translation></message>
<message><source>One hint a line, shown one at a time</source><translation>Ein Hinweis je Zeile; sie werden einzeln gezeigt</translation></message>
<message><source>One of several answers</source><translation>Eine von mehreren Antworten</translation></message>
<message><source>Question</source><translation>Frage</translation></message>
<message><source>Question without grade</source><translation>Frage ohne Bewertung</translation></message>
<message><source>Right answer</source><translation>Richtige Antwort</translation></message>
<message><source>Set the window so that the goal is reached, then press this</source><translation>Das Fenster so einstellen, dass das Ziel erreicht ist, dann hier drücken</translation></message>
<message><source>Sliders to be set</source><translation>Regler einzustellen</translation></message>
<message><source>Step {number}: {words}</source><translation>Schritt {number}: {words}</translation></message>
<message><source>Test my lesson</source><translation>Meine Lektion prüfen</translation></message>
<message><source>The sliders as they are now solve it</source><translation>Die Regler, wie sie jetzt stehen, lösen sie</translation></message>
<message><source>There is no lesson under way; begin one, or press Test my lesson where you make one</source><translation>Es läuft keine Lektion; eine beginnen, oder beim Erstellen auf Meine Lektion prüfen drücken</translation></message>
<message><source>What is wrong with the lesson</source><translation>Was an der Lektion nicht stimmt</translation></message>
<message><source>What the step asks for</source><translation>Wonach der Schritt fragt</translation></message>
<message><source>Wrong answer</source><translation>Falsche Antwort</translation></message>
<message><source>the goal is reached before anything is moved; begin elsewhere</source><translation>das Ziel ist erreicht, bevor etwas bewegt wird; woanders beginnen</translation></message>
<message><source>the hint for {value} is never shown; another comes first</source><translation>der Hinweis für {value} wird nie gezeigt; ein anderer kommt ihm zuvor</translation></message>
<message><source>the right order is listed as a wrong one; leave it out</source><translation>die richtige Reihenfolge steht bei den falschen; sie weglassen</translation></message>
<message><source>the wrong answer {value} counts as right; narrow the tolerance</source><translation>die falsche Antwort {value} gilt als richtig; die Toleranz enger machen</translation></message>
<message><source>the wrong answer “{option}” has no hint; add one</source><translation>die falsche Antwort „{option}“ hat keinen Hinweis; einen anfügen</translation></message>
<message><source>two tasks are named "{name}"; name one otherwise</source><translation>zwei Aufgaben heißen "{name}"; eine anders nennen</translation></message>
<message><source>what solves the goal does not reach it: {why}</source><translation>was das Ziel lösen soll, erreicht es nicht: {why}</translation></message>
<message><source>{claim}: {value} is measured</source><translation>{claim}: gemessen wird {value}</translation></message>
<message><source>{count} checks were made, and nothing is wrong.</source><translation>{count} Prüfungen wurden gemacht, und nichts ist falsch.</translation></message>
<message><source>{count} checks were made; this is wrong:</source><translation>{count} Prüfungen wurden gemacht; das ist falsch:</translation></message>
<message><source>Tasks right</source><translation>Aufgaben richtig</translation></message>
<message><source>Name</source><translation>Name</translation></message>
<message><source>Concept check of {count}: {before} right before, {after} after, gain {gain}</source><translation>Verständnistest von {count}: {before} vorher richtig, {after} nachher, Gewinn {gain}</translation></message>
<message><source>Gain: the share of what was wrong before that is right after (Hake 1998)</source><translation>Gewinn: der Anteil dessen, was vorher falsch war und nachher richtig ist (Hake 1998)</translation></message>
<message><source>field 34° is beyond 14°, the largest; type a smaller one</source><translation>Feld 34° liegt jenseits von 14°, dem größten; ein kleineres eingeben</translation></message>
<message><source>Show only such lenses; press again for all</source><translation>Nur solche Objektive zeigen; noch einmal drücken für alle</translation></message>
<message><source>Shows coma</source><translation>Zeigt Koma</translation></message>
<message><source>Steps of the lesson</source><translation>Schritte der Lektion</translation></message>
<message><source>Telephoto</source><translation>Teleobjektiv</translation></message>
<message><source>Text</source><translation>Text</translation></message>
<message><source>The best focus is about {shift} µm away: defocus by {causes}, {percent:.0f} % of variance</source><translation>Der beste Fokus ist etwa {shift} µm entfernt: Defokus durch {causes}, {percent:.0f} % der Varianz</translation></message>
<message><source>the mosaic "{mosaic}" is unknown; choose {choices}</source><translation>das Mosaik „{mosaic}“ ist unbekannt; {choices} wählen</translation></message>
<message><source>the mosaic {mosaic} needs red, green and blue, but the picture has {count} channels; change one of them</source><translation>das Mosaik {mosaic} braucht Rot, Grün und Blau, aber das Bild hat {count} Kanäle; eines von beiden ändern</translation></message>
<message><source>the mosaic {mosaic} needs red, green and blue, but the scene has {count} channels; change one of them</source><translation>das Mosaik {mosaic} braucht Rot, Grün und Blau, aber die Szene hat {count} Kanäle; eines von beiden ändern</translation></message>
<message><source>the sensor has no bits, and so no raw numbers; state them</source><translation>der Sensor hat keine Bits und darum keine Rohzahlen; sie angeben</translation></message>
<message><source>there are both [filters] and [[channel]]; keep one of them</source><translation>es gibt [filters] und [[channel]]; nur eines davon behalten</translation></message>
<message><source>there is no {key}; write a table [filters] with curves = "FILE.csv" under it</source><translation>{key} fehlt; eine Tabelle [filters] mit curves = "DATEI.csv" darunter schreiben</translation></message>
<message><source>Title</source><translation>Titel</translation></message>
<message><source>What the stage shows; right-click to choose the parts of this line</source><translation>Was die Bühne zeigt; Rechtsklick wählt die Teile dieser Zeile</translation></message>
<message><source> ({count} fr.)</source><translation> ({count} Ringe)</translation></message>
<message><source>"{entry}" sets nothing; write entries such as field_deg 10, tab mtf</source><translation>"{entry}" stellt nichts ein; Einträge schreiben wie field_deg 10, tab mtf</translation></message>
<message><source>"{glass}" (nd {nd:.6f})</source><translation>"{glass}" (nd {nd:.6f})</translation></message>
<message><source>"{line}" is not an entry of the header; give {names}</source><translation>"{line}" ist kein Eintrag des Kopfes; {names} angeben</translation></message>
<message><source>"{name}" is not a slider; move one of {names}</source><translation>"{name}" ist kein Regler; einen von {names} bewegen</translation></message>
<message><source>"{name}" is nothing that a frame tells here; choose from {choices}</source><translation>"{name}" ist nichts, was eine Aufnahme hier sagt; wählen aus {choices}</translation></message>
<message><source>"{name}": the lens has surfaces 1 to {count}; decentres and tilts take one, or the ends of a piece as in tilt_x:3-4; radius and index take one, and thickness any but the last</source><translation>"{name}": Das Objektiv hat die Flächen 1 bis {count}; Dezentrierungen und Kippungen nehmen eine oder die Enden eines Stücks wie in tilt_x:3-4, radius und index eine, thickness jede außer der letzten</translation></message>
<message><source>"{name}:" is not an entry of a step here; give {names}</source><translation>"{name}:" ist hier kein Eintrag eines Schritts; {names} angeben</translation></message>
<message><source>"{text}" in a claim is not a number; write one such as 0.25 or 1e-3</source><translation>"{text}" in einer Behauptung ist keine Zahl; eine wie 0.25 oder 1e-3 schreiben</translation></message>
<message><source>"{text}" is not a claim; write one such as {example}</source><translation>"{text}" ist keine Behauptung; eine schreiben wie {example}</translation></message>
<message><source>"{text}" is not a scale to hold; write for example psf 30</source><translation>"{text}" ist keine Skala zum Festhalten; etwa psf 30 schreiben</translation></message>
<message><source>"{text}" is not an error of a build; write for example decentre_y 3-4 0.2</source><translation>"{text}" ist kein Fehler eines Exemplars; etwa decentre_y 3-4 0.2 schreiben</translation></message>
<message><source>"{text}": "is" needs a tolerance such as ± 0.01, and "above" and "below" take none</source><translation>"{text}": "is" braucht eine Toleranz wie ± 0.01, "above" und "below" haben keine</translation></message>
<message><source>% of peak</source><translation>% der Spitze</translation></message>
<message><source>+ no astigmatism (third order)</source><translation>+ kein Astigmatismus (dritte Ordnung)</translation></message>
<message><source>0.7 of the pupil</source><translation>0,7 der Pupille</translation></message>
<message><source>1 node</source><translation>1 Knoten</translation></message>
<message><source>1 surface</source><translation>1 Fläche</translation></message>
<message><source>1 − R²</source><translation>1 − R²</translation></message>
<message><source>1/depth, 1/m (0 is ∞)</source><translation>1/Abstand, 1/m (0 ist ∞)</translation></message>
<message><source>1/depth, 1/mm</source><translation>1/Abstand, 1/mm</translation></message>
<message><source>16 µm pixels</source><translation>16-µm-Pixel</translation></message>
<message><source>32 µm pixels</source><translation>32-µm-Pixel</translation></message>
<message><source>3D</source><translation>3D</translation></message>
<message><source>3D is not in this download; take the one with 3D in its name, then open this panel again</source><translation>3D ist in diesem Download nicht enthalten; den mit 3D im Namen nehmen und diese Tafel dann wieder öffnen</translation></message>
<message><source>3D needs OpenGL, and none works here; install a driver or Mesa's software renderer (apt-get install libegl1 libgl1-mesa-dri), then open this panel again</source><translation>3D braucht OpenGL, und hier läuft keines; einen Treiber oder Mesas Software-Renderer installieren (apt-get install libegl1 libgl1-mesa-dri), dann diese Ansicht wieder öffnen</translation></message>
<message><source>3D needs pyvista, which is not installed; run pip install pyvista, then open this panel again</source><translation>3D braucht pyvista, das nicht installiert ist; pip install pyvista ausführen, dann diese Ansicht wieder öffnen</translation></message>
<message><source>3D: the elements up to their clear rims; the wavefront is drawn W·λ ahead of the sphere about the image point.</source><translation>3D: Drehkörper bis zu ihren freien Rändern; die Wellenfront ist der Kugel um den Bildpunkt um W·λ voraus.</translation></message>
<message><source>4 µm pixels</source><translation>4-µm-Pixel</translation></message>
<message><source>8 µm pixels</source><translation>8-µm-Pixel</translation></message>
<message><source>?</source><translation>?</translation></message>
<message><source>A and B side by side, or A alone</source><translation>A und B nebeneinander oder A allein</translation></message>
<message><source>A screen of bright points, stars, or a PSF: the panel finds the wavefront behind each of them.</source><translation>Ein Schirm mit hellen Punkten, Sterne oder eine PSF: die Ansicht findet zu jedem die Wellenfront.</translation></message>
<message><source>A</source><translation>A</translation></message>
<message><source>A and B are the same: move a control, or choose another lens or method</source><translation>A und B sind gleich: bewegen Sie einen Regler oder wählen Sie ein anderes Objektiv oder Verfahren</translation></message>
<message><source>A back focus longer than the focal length: a wide angle that leaves room for a mirror</source><translation>Schnittweite länger als die Brennweite: ein Weitwinkel, das einem Spiegel Platz lässt</translation></message>
<message><source>A camera in Python</source><translation>Eine Kamera in Python</translation></message>
<message><source>A corrector plate of some micrometres at the centre of a spherical mirror: sharp over five degrees</source><translation>Eine Korrektionsplatte von einigen Mikrometern im Mittelpunkt eines Kugelspiegels: scharf über fünf Grad</translation></message>
<message><source>A field of {angle:.0f}° is far outside the paraxial range, where six coefficients only sketch the PSF; choose fitted or traced.</source><translation>Ein Feld von {angle:.0f}° liegt weit außerhalb des paraxialen Bereichs, wo sechs Koeffizienten die PSF nur skizzieren; fitted oder traced wählen.</translation></message>
<message><source>A lesson, with its subject on the stage (F3)</source><translation>Eine Lektion, und worum es in ihr geht, auf der Bühne (F3)</translation></message>
<message><source>A meniscus and a stop behind it: coma removed by moving the stop, as in later box cameras</source><translation>Ein Meniskus und dahinter eine Blende: Koma durch den Ort der Blende behoben, wie in späteren Boxkameras</translation></message>
<message><source>A paraboloid and a hyperboloid: no spherical aberration at all, but coma, and a hole in the pupil</source><translation>Ein Paraboloid und ein Hyperboloid: gar keine sphärische Aberration, aber Koma und ein Loch in der Pupille</translation></message>
<message><source>A photograph through the lens on the stage</source><translation>Eine Fotografie durch das Objektiv auf der Bühne</translation></message>
<message><source>A ray aimed at N leaves from N′ in its old direction; from the first vertex.</source><translation>Ein auf N gerichteter Strahl tritt aus N′ in alter Richtung aus; vom ersten Scheitel.</translation></message>
<message><source>A ray aimed at N leaves from N′ in its old direction; from the last vertex.</source><translation>Ein auf N gerichteter Strahl tritt aus N′ in alter Richtung aus; vom letzten Scheitel.</translation></message>
<message><source>A real 35 mm wide angle for a reflex camera: long back focus, astigmatism and distortion at the corner</source><translation>Ein echtes 35-mm-Weitwinkel für eine Spiegelreflexkamera: lange Schnittweite, Astigmatismus und Verzeichnung in der Ecke</translation></message>
<message><source>A standard lens wide open: seven elements, large and balanced aberrations, strong vignetting</source><translation>Ein Normalobjektiv bei voller Öffnung: sieben Linsen, große und gegeneinander abgewogene Aberrationen, starke Vignettierung</translation></message>
<message><source>A stock singlet, right way round: spherical aberration, coma and colour, undisguised</source><translation>Eine Einzellinse ab Lager, richtig herum: sphärische Aberration, Koma und Farbe, unverhüllt</translation></message>
<message><source>A thick meniscus undoes the spherical aberration of spherical mirrors: no asphere anywhere</source><translation>Ein dicker Meniskus hebt die sphärische Aberration der Kugelspiegel auf: nirgends eine Asphäre</translation></message>
<message><source>A triplet whose last element became a doublet: flatter field</source><translation>Ein Triplet, dessen letzte Linse zum Kittglied wurde: ebeneres Feld</translation></message>
<message><source>A workspace of your own; it stays as you leave it</source><translation>Ein eigener Arbeitsbereich; er bleibt, wie Sie ihn verlassen</translation></message>
<message><source>A − B</source><translation>A − B</translation></message>
<message><source>A − B {part} at {field}</source><translation>A − B {part} bei {field}</translation></message>
<message><source>A − B · at most {share} % of the higher peak</source><translation>A − B · höchstens {share} % der höheren Spitze</translation></message>
<message><source>A − B, share of the higher peak</source><translation>A − B, Anteil der höheren Spitze</translation></message>
<message><source>A4 A6 … (mm⁻³ mm⁻⁵ …)</source><translation>A4 A6 … (mm⁻³ mm⁻⁵ …)</translation></message>
<message><source>Aberrations</source><translation>Aberrationen</translation></message>
<message><source>Absorption</source><translation>Absorption</translation></message>
<message><source>Absorption of the glasses: on or off</source><translation>Absorption der Gläser: an oder aus</translation></message>
<message><source>Accept substitutes</source><translation>Ersatz annehmen</translation></message>
<message><source>Accuracy</source><translation>Genauigkeit</translation></message>
<message><source>Above NA {na} light is a vector, and sums of scalar waves miss unpolarised light by more than 1 − R² = 0.001.</source><translation>Über NA {na} ist Licht ein Vektor, und Summen skalarer Wellen verfehlen unpolarisiertes Licht um mehr als 1 − R² = 0,001.</translation></message>
<message><source>Accuracy: R² = 1 − Σ(reference − PSF)²/Σ(reference − mean)² against a converged sum of traced rays (Huygens).</source><translation>Genauigkeit: R² = 1 − Σ(Referenz − PSF)²/Σ(Referenz − Mittel)² gegen eine auskonvergierte Summe verfolgter Strahlen (Huygens).</translation></message>
<message><source>Added waves</source><translation>Hinzugefügte Wellen</translation></message>
<message><source>Airy</source><translation>Airy</translation></message>
<message><source>Airy radius</source><translation>Airy-Radius</translation></message>
<message><source>Airy radius, the circle</source><translation>Airy-Radius, der Kreis</translation></message>
<message><source>All</source><translation>Alle</translation></message>
<message><source>All at once</source><translation>Alles zugleich</translation></message>
<message><source>All pictures share one scale; otherwise each has its own</source><translation>Alle Bilder haben einen Maßstab; sonst hat jedes seinen eigenen</translation></message>
<message><source>An aperture of NA {na:.2f} is far outside the paraxial range, where six coefficients only sketch the PSF; choose fitted or traced.</source><translation>Eine Öffnung von NA {na:.2f} liegt weit außerhalb des paraxialen Bereichs, wo sechs Koeffizienten die PSF nur skizzieren; fitted oder traced wählen.</translation></message>
<message><source>An aspheric f/2 condenser: a conic and two polynomial terms against spherical aberration</source><translation>Ein asphärischer Kondensor f/2: ein Kegelschnitt und zwei Polynomglieder gegen sphärische Aberration</translation></message>
<message><source>Animated GIF (*.gif);;MP4 film (*.mp4);;Numbered PNG frames (*.png)</source><translation>Animiertes GIF (*.gif);;MP4-Film (*.mp4);;Nummerierte PNG-Bilder (*.png)</translation></message>
<message><source>Apodisation</source><translation>Apodisation</translation></message>
<message><source>Apodisation power</source><translation>Potenz der Apodisation</translation></message>
<message><source>Apodisation power p of the amplitude exp(−(ρ/width)ᵖ): 2 is a Gaussian, a larger even number a super-Gaussian.</source><translation>Potenz p der Amplitude exp(−(ρ/Breite)ᵖ): 2 eine Gauß-Funktion, größere gerade Zahlen eine Super-Gauß-Funktion.</translation></message>
<message><source>Apodisation: the radius, as a share of the rim's, where the amplitude has fallen to 1/e and the intensity to 1/e²; ∞: uniform light. It dims the rings and widens the core.</source><translation>Apodisation: wo die Amplitude auf 1/e und die Intensität auf 1/e² gefallen ist, über dem Radius des Randes; ∞: gleichmäßiges Licht. Sie schwächt die Ringe und verbreitert den Kern.</translation></message>
<message><source>As built…</source><translation>Wie gebaut …</translation></message>
<message><source>As designed</source><translation>Wie entworfen</translation></message>
<message><source>As the grade</source><translation>Wie die Klasse</translation></message>
<message><source>As the system</source><translation>Wie das System</translation></message>
<message><source>Aspheric plano-convex condenser, f/2 (synthetic)</source><translation>Asphärischer plankonvexer Kondensor, f/2 (synthetisch)</translation></message>
<message><source>Aspheric terms A4·r⁴ + A6·r⁶ + …, separated by spaces.</source><translation>Asphärische Glieder A4·r⁴ + A6·r⁶ + …, mit Leerzeichen dazwischen.</translation></message>
<message><source>Astigmatism, 1 λ, medial focus</source><translation>Astigmatismus, 1 λ, mittlerer Fokus</translation></message>
<message><source>Astigmatism, 2 λ, sagittal focus</source><translation>Astigmatismus, 2 λ, sagittaler Fokus</translation></message>
<message><source>Astigmatism, 2 λ, tangential focus</source><translation>Astigmatismus, 2 λ, tangentialer Fokus</translation></message>
<message><source>At</source><translation>Bei</translation></message>
<message><source>Atlas of PSFs over depth and field</source><translation>Atlas der PSFs über Abstand und Feld</translation></message>
<message><source>Autofocus: best RMS wavefront</source><translation>Autofokus: kleinster RMS von W</translation></message>
<message><source>Azimuth</source><translation>Azimut</translation></message>
<message><source>B</source><translation>B</translation></message>
<message><source>B is on screen, and the controls move A; show A, or swap the two, to change this one</source><translation>B ist zu sehen, und die Regler bewegen A; A zeigen oder beide tauschen, um dieses zu ändern</translation></message>
<message><source>Back</source><translation>Zurück</translation></message>
<message><source>Back focus F′</source><translation>Bildseitiger Brennpunkt F′</translation></message>
<message><source>Back to file</source><translation>Zurück zur Datei</translation></message>
<message><source>Back to the lens's own coefficients: nothing added, muted or solo</source><translation>Zurück zu den Koeffizienten des Objektivs: nichts hinzugefügt, stumm oder solo</translation></message>
<message><source>Back to the tabs</source><translation>Zurück zu den Reitern</translation></message>
<message><source>Begin or leave a lesson</source><translation>Lektion beginnen oder verlassen</translation></message>
<message><source>Bending X</source><translation>Durchbiegung X</translation></message>
<message><source>Bending: the shape factor X = (c₁ + c₂)/(c₁ − c₂) of the selected element; its thin-lens power does not change. 0 is equiconvex or equiconcave, ±1 has one plane side. Select an element in the layout or in the table.</source><translation>Durchbiegung: der Formfaktor X = (c₁ + c₂)/(c₁ − c₂) des gewählten Elements; seine Brechkraft als dünne Linse bleibt. 0 ist gleichseitig bikonvex oder bikonkav, bei ±1 ist eine Seite eben. Wählen Sie ein Element im Schnittbild oder in der Tabelle.</translation></message>
<message><source>Best-form singlet f/6, 20 mm</source><translation>Einzellinse bester Form f/6, 20 mm</translation></message>
<message><source>Blade angle</source><translation>Lamellenwinkel</translation></message>
<message><source>Blade angle: direction of the first corner, from the direction of the field (+η) towards +ξ.</source><translation>Lamellenwinkel: Richtung der ersten Ecke, von der Richtung des Feldes (+η) nach +ξ.</translation></message>
<message><source>Blades</source><translation>Lamellen</translation></message>
<message><source>Blades of the iris, their corners on the rim's circle; 0: round. An even number of blades gives as many spikes in the PSF, an odd number twice as many.</source><translation>Lamellen der Irisblende, ihre Ecken auf dem Kreis des Randes; 0: rund. Die PSF hat ebenso viele Strahlen, wo ihre Zahl gerade ist, doppelt so viele, wo sie ungerade ist.</translation></message>
<message><source>Both halves move apart as it comes closer: sharp from infinity to more than half of life size</source><translation>Beide Hälften rücken beim Nahen auseinander: scharf von unendlich bis über die halbe Lebensgröße</translation></message>
<message><source>Brightness scale</source><translation>Helligkeitsskala</translation></message>
<message><source>Brightness: each picture relative to its own peak, or with One scale all relative to the brightest</source><translation>Helligkeit: jedes Bild auf seine eigene Spitze bezogen oder mit Ein Maßstab alle auf die hellste</translation></message>
<message><source>Build ten thousand other lenses</source><translation>Zehntausend andere Objektive bauen</translation></message>
<message><source>By how much the f-number exceeds the stated one, which is taken to be right to 3 %.</source><translation>Um wie viel die Blendenzahl die angegebene übertrifft, die auf 3 % genau gilt.</translation></message>
<message><source>C I axial colour</source><translation>C I Farblängsfehler</translation></message>
<message><source>C II lateral colour</source><translation>C II Farbquerfehler</translation></message>
<message><source>Cancel</source><translation>Abbrechen</translation></message>
<message><source>Cancelled; nothing was written</source><translation>Abgebrochen; nichts wurde geschrieben</translation></message>
<message><source>Cassegrain telescope f/10, 200 mm</source><translation>Cassegrain-Teleskop f/10, 200 mm</translation></message>
<message><source>Cemented achromat f/6, 20 mm</source><translation>Verkitteter Achromat f/6, 20 mm</translation></message>
<message><source>Centroid y</source><translation>Schwerpunkt y</translation></message>
<message><source>Checkerboard</source><translation>Schachbrett</translation></message>
<message><source>Choose a PNG, TIFF, OpenEXR, JPEG or HEIF to photograph, up to 12 megapixels</source><translation>Ein PNG, TIFF, OpenEXR, JPEG oder HEIF zum Fotografieren wählen, bis zu 12 Megapixel</translation></message>
<message><source>Choose a lesson</source><translation>Eine Lektion wählen</translation></message>
<message><source>Choose a photo</source><translation>Ein Foto wählen</translation></message>
<message><source>Choose a picture of points</source><translation>Ein Bild von Punkten wählen</translation></message>
<message><source>Choose a picture of points to measure</source><translation>Ein Bild von Punkten wählen, um es zu vermessen</translation></message>
<message><source>Choose a shipped lens (Ctrl+L); for files use Open (Ctrl+O)</source><translation>Das Objektiv: die Galerie der mitgelieferten öffnen (Strg+L); Dateien sind unter Öffnen (Strg+O)</translation></message>
<message><source>Choose a shipped lens…</source><translation>Mitgeliefertes Objektiv wählen …</translation></message>
<message><source>Chromatic shift</source><translation>Farblängsfehler</translation></message>
<message><source>Cividis</source><translation>Cividis</translation></message>
<message><source>Clear pupil: no obscuration, blades, vanes, apodisation or cubic phase</source><translation>Freie Pupille: keine Abschattung, Lamellen, Streben, Apodisation oder kubische Phase</translation></message>
<message><source>Clear rim, mm; ∞ is unlimited. On the stop it is the aperture.</source><translation>Freier Rand, mm; ∞ ist unbegrenzt. An der Blende ist er die Öffnung.</translation></message>
<message><source>Click or press Enter to make this surface the stop; the f-number does not change.</source><translation>Klicken oder Enter macht diese Fläche zur Blende; die Blendenzahl bleibt.</translation></message>
<message><source>Click to select this element, then drag it, its edges and its vertices.</source><translation>Ein Klick wählt dieses Element; dann lässt sich an ihm, seinen Rändern und Scheiteln ziehen.</translation></message>
<message><source>Clip at rims</source><translation>Randbeschnitt</translation></message>
<message><source>Clip: rays beyond a clear semi-diameter are lost, which vignettes the pupil off axis.</source><translation>Randbeschnitt: Strahlen jenseits eines freien Halbmessers gehen verloren; das vignettiert die Pupille außerhalb der Achse.</translation></message>
<message><source>Close</source><translation>Schließen</translation></message>
<message><source>Close the build, and show the lens as designed</source><translation>Das Exemplar schließen und das Objektiv wie entworfen zeigen</translation></message>
<message><source>Close the explorer</source><translation>Explorer schließen</translation></message>
<message><source>Close the window</source><translation>Fenster schließen</translation></message>
<message><source>Coarse</source><translation>Grob</translation></message>
<message><source>Coefficients</source><translation>Koeffizienten</translation></message>
<message><source>Colour</source><translation>Farbe</translation></message>
<message><source>Colour PSF: one PSF for each wavelength, where its own chief ray lands, weighted by the spectrum and the CIE 1931 observer, as linear sRGB. Beside or below: the luminance of the spectrum, and where each colour's chief ray lands.</source><translation>Farbige PSF: eine PSF je Wellenlänge dort, wo ihr eigener Hauptstrahl landet, gewichtet mit Spektrum und CIE-Beobachter 1931, als lineares sRGB. Daneben oder darunter: die Leuchtdichte des Spektrums und wo der Hauptstrahl jeder Farbe landet.</translation></message>
<message><source>Colour {channel}</source><translation>Farbe {channel}</translation></message>
<message><source>Colours</source><translation>Farben</translation></message>
<message><source>Coma, 3 λ</source><translation>Koma, 3 λ</translation></message>
<message><source>Coma, ½ λ</source><translation>Koma, ½ λ</translation></message>
<message><source>Compare</source><translation>Vergleich</translation></message>
<message><source>Compared with the scene, the blurred picture has {blurred}; sharpened by its own PSFs {own}; by the PSF on the axis {axis} (Wiener's filter, noise {noise:.1%} of white; PSNR of linear light, SSIM of sRGB levels).</source><translation>Gegenüber der Szene hat das unscharfe Bild {blurred}, geschärft mit seinen eigenen PSFs {own}, mit der PSF der Achse {axis} (Wiener-Filter, Rauschen {noise:.1%} von Weiß; PSNR des linearen Lichts, SSIM der sRGB-Stufen).</translation></message>
<message><source>Compensators</source><translation>Kompensatoren</translation></message>
<message><source>Compensators: {count}</source><translation>Kompensatoren: {count}</translation></message>
<message><source>Conic K</source><translation>Konik K</translation></message>
<message><source>Conic constant K = −e²: 0 a sphere, −1 a paraboloid.</source><translation>Kegelschnittkonstante K = −e²: 0 eine Kugel, −1 ein Paraboloid.</translation></message>
<message><source>Contents</source><translation>Inhalt</translation></message>
<message><source>Controls</source><translation>Regler</translation></message>
<message><source>Cooke triplet, f/5, 50 mm, 40 degree field</source><translation>Cooke-Triplet, f/5, 50 mm, 40 Grad Feld</translation></message>
<message><source>Copied</source><translation>Kopiert</translation></message>
<message><source>Copied a link of {count} characters; paste it into a window of the explorer</source><translation>Link aus {count} Zeichen kopiert; in ein Fenster des Explorers einfügen</translation></message>
<message><source>Copy a link to what is on screen</source><translation>Link auf das Gezeigte kopieren</translation></message>
<message><source>Copy data as CSV</source><translation>Daten als CSV kopieren</translation></message>
<message><source>Copy link</source><translation>Link kopieren</translation></message>
<message><source>Copy picture</source><translation>Bild kopieren</translation></message>
<message><source>Copy the panel's data as CSV</source><translation>Daten der Ansicht als CSV kopieren</translation></message>
<message><source>Copy the panel's picture</source><translation>Bild der Ansicht kopieren</translation></message>
<message><source>Copy the report</source><translation>Bericht kopieren</translation></message>
<message><source>Crown and flint cemented: colour and spherical aberration corrected, field curvature not</source><translation>Kron und Flint verkittet: Farbe und sphärische Aberration korrigiert, Bildfeldwölbung nicht</translation></message>
<message><source>Cubic phase</source><translation>Kubische Phase</translation></message>
<message><source>Cubic phase plate: α of the optical path α(ξ³ + η³) that it adds. It blurs every depth nearly alike, so one deconvolution can remove the blur.</source><translation>Kubische Phasenplatte: α des optischen Weges α(ξ³ + η³), den sie hinzufügt. Sie verwischt alle Abstände fast gleich, was eine einzige Entfaltung behebt.</translation></message>
<message><source>Dark</source><translation>Dunkel</translation></message>
<message><source>Database</source><translation>Datenbank</translation></message>
<message><source>Database: every coefficient over depth and field at this wavelength, as polynomials that are exact to round-off. Drag on a map or the atlas, or use the arrow keys and Enter, to choose the source.</source><translation>Datenbank: jeder Koeffizient über Abstand und Feld bei dieser Wellenlänge, als Polynome bis auf Rundung genau; Ziehen auf Karte oder Atlas, oder Pfeiltasten und Enter, setzen die Quelle.</translation></message>
<message><source>Decentre x</source><translation>Dezentrierung x</translation></message>
<message><source>Decentre x: the piece is moved sideways, out of the layout's plane.</source><translation>Dezentrierung x: das Teil wird zur Seite bewegt, aus der Ebene des Aufbaus hinaus.</translation></message>
<message><source>Decentre y</source><translation>Dezentrierung y</translation></message>
<message><source>Decentre y: the piece is moved up.</source><translation>Dezentrierung y: das Teil wird nach oben bewegt.</translation></message>
<message><source>Defocus is {waves} λ, beyond the 10 λ that the paper considers; bring focus or source nearer, or stop down.</source><translation>Der Defokus ist {waves} λ, jenseits der 10 λ, bis zu denen der Aufsatz geht; Fokus oder Quelle näher bringen oder abblenden.</translation></message>
<message><source>Defocus, 1 λ</source><translation>Defokus, 1 λ</translation></message>
<message><source>Delete</source><translation>Löschen</translation></message>
<message><source>Delete this one</source><translation>Diesen löschen</translation></message>
<message><source>Depth</source><translation>Objektabstand</translation></message>
<message><source>Depth of field</source><translation>Schärfentiefe</translation></message>
<message><source>Depth of field: the depths whose blur is no wider than the tolerated one. Paraxial: diameter of the cone from the axial point on the sensor, linear in 1/distance. Exact rays: twice the RMS radius of the spot at the present field.</source><translation>Schärfentiefe: Abstände, deren Unschärfe nicht breiter als erlaubt ist. Paraxial: Durchmesser des Kegels des Achspunkts auf dem Sensor, linear in 1/Abstand. Exakte Strahlen: doppelter RMS-Radius des Spots am jetzigen Feld.</translation></message>
<message><source>Depth: distance from the source to the first vertex. Half of the slider goes from ten focal lengths to ∞; far away its steps are equal in dioptres, 1/depth. ▾ marks where the lens is focused.</source><translation>Objektabstand: von der Quelle bis zum ersten Scheitel. Die Hälfte des Reglers reicht von zehn Brennweiten bis ∞; in der Ferne ist er gleichmäßig in Dioptrien, 1/Abstand. ▾ zeigt, worauf das Objektiv fokussiert ist.</translation></message>
<message><source>Depths</source><translation>Abstände</translation></message>
<message><source>Diffraction-limited: RMS {rms} λ</source><translation>Beugungsbegrenzt: RMS {rms} λ</translation></message>
<message><source>Discard all edits and return to the lens in the file</source><translation>Alle Änderungen verwerfen und das Objektiv nehmen, wie es in der Datei steht</translation></message>
<message><source>Discard all your own values</source><translation>Alle eigenen Werte verwerfen</translation></message>
<message><source>Dismiss</source><translation>Ausblenden</translation></message>
<message><source>Distance to the next vertex, mm; the last one to the sensor.</source><translation>Abstand zum nächsten Scheitel, mm; der letzte zum Sensor.</translation></message>
<message><source>Distances with units, ∞ included: 500 mm; 2 m; ∞. A range, evenly spaced in 1/distance: 1 m:∞:4</source><translation>Abstände mit ihren Einheiten, auch ∞: 500 mm; 2 m; ∞. Eine Reihe, gleichmäßig in 1/Abstand: 1 m:∞:4</translation></message>
<message><source>Double Gauss, 28 degree field, f/3, 100 mm</source><translation>Doppel-Gauß, 28 Grad Feld, f/3, 100 mm</translation></message>
<message><source>Drag a slider: lens, pupil and PSF follow. Hover over a name for its definition.</source><translation>Einen Regler ziehen: Objektiv, Pupille und PSF folgen. Über einem Namen steht seine Definition.</translation></message>
<message><source>Drag or use the arrow keys to turn the surface; a double-click goes back</source><translation>Ziehen oder die Pfeiltasten drehen die Fläche; ein Doppelklick führt zurück</translation></message>
<message><source>Drag the line or click, or use the left and right arrow keys: the sensor follows.</source><translation>Die Linie ziehen, klicken oder die Pfeiltasten links und rechts: der Sensor folgt.</translation></message>
<message><source>Draw again</source><translation>Neu ziehen</translation></message>
<message><source>Drop a picture of points here</source><translation>Ein Bild von Punkten hier ablegen</translation></message>
<message><source>Drop to open the link</source><translation>Loslassen öffnet den Link</translation></message>
<message><source>Drop to open {file}</source><translation>Loslassen öffnet {file}</translation></message>
<message><source>EFL {focal} mm, {speed} · {column}</source><translation>EFL {focal} mm, {speed} · {column}</translation></message>
<message><source>Each PSF is the light of one point on the pixels of a sensor, with the chief ray on the middle pixel. The file also has the place of each chief ray on the sensor and the share of light captured. Coefficients altered by hand are ignored. Put semicolons between the values of a list; first : last : count is a range, evenly spaced, in 1/distance for depths.</source><translation>Jede PSF ist, was die Pixel eines Sensors vom Licht eines Punktes bekommen, der Hauptstrahl auf dem mittleren Pixel. Dazu kommen der Ort ihres Hauptstrahls auf dem Sensor und das aufgefangene Licht. Von Hand geänderte Koeffizienten bleiben außen vor. Zwischen den Werten einer Liste stehen Semikolons; erster : letzter : Anzahl ist eine Reihe gleichmäßiger Schritte, bei Abständen in 1/Abstand.</translation></message>
<message><source>Effective focal length f′ = −1/C of the system matrix.</source><translation>Brennweite f′ = −1/C der Systemmatrix.</translation></message>
<message><source>EnP</source><translation>EnP</translation></message>
<message><source>End the lesson and restore everything as it was before (F3)</source><translation>Die Lektion beenden und alles zurückstellen, wie es vorher war (F3)</translation></message>
<message><source>Entrance pupil</source><translation>Eintrittspupille</translation></message>
<message><source>Error</source><translation>Fehler</translation></message>
<message><source>Errors by their harm</source><translation>Fehler nach ihrem Schaden</translation></message>
<message><source>Escape</source><translation>Escape</translation></message>
<message><source>Every panel by its group (Alt+0)</source><translation>Jede Ansicht nach ihrer Gruppe (Alt+0)</translation></message>
<message><source>ExP</source><translation>ExP</translation></message>
<message><source>Exact rays have {exact} λ from peak to valley, the six coefficients {six} λ: these are paraxial, and the rays are too steep for that here; pupil and PSF are of exact rays.</source><translation>Exakte Strahlen haben {exact} λ von Spitze zu Tal, die sechs Koeffizienten {six} λ: diese sind paraxial, und dafür sind die Strahlen hier zu steil; Pupille und PSF zeigen exakte Strahlen.</translation></message>
<message><source>Exchange A and B</source><translation>A und B vertauschen</translation></message>
<message><source>B is pinned; the controls move A · Swap to move this one</source><translation>B ist gemerkt; die Regler bewegen A · Tauschen, um dieses zu bewegen</translation></message>
<message><source>Exchange A and B: the controls then move the other one</source><translation>A und B vertauschen: die Regler bewegen dann das andere</translation></message>
<message><source>Exit</source><translation>Beenden</translation></message>
<message><source>Exit pupil</source><translation>Austrittspupille</translation></message>
<message><source>Explore</source><translation>Erkunden</translation></message>
<message><source>Explorer states (*.json)</source><translation>Zustände des Explorers (*.json)</translation></message>
<message><source>Export</source><translation>Export</translation></message>
<message><source>Export a set of PSFs</source><translation>Einen Satz PSFs exportieren</translation></message>
<message><source>Export a set of PSFs…</source><translation>Einen Satz PSFs exportieren …</translation></message>
<message><source>Export…</source><translation>Exportieren …</translation></message>
<message><source>FFT of {samples} × {samples} pupil samples</source><translation>FFT aus {samples} × {samples} Pupillenproben</translation></message>
<message><source>FITS files need astropy, which is not installed; pip install 'p2sf[fits]'</source><translation>FITS-Dateien brauchen astropy, das nicht installiert ist; pip install 'p2sf[fits]'</translation></message>
<message><source>Factor by which the drawing enlarges the tilts and decentres of the Misalign panel</source><translation>Wievielfach Kippungen und Dezentrierungen aus dem Feld Dejustieren in der Zeichnung vergrößert sind</translation></message>
<message><source>Farthest ray</source><translation>Fernster Strahl</translation></message>
<message><source>Fast double Gauss f/1.4, 50 mm</source><translation>Lichtstarker Doppel-Gauß f/1,4, 50 mm</translation></message>
<message><source>Fast, for a narrow field: very good on axis, but the curved field soon leaves the sensor</source><translation>Lichtstark bei kleinem Feld: sehr gut auf der Achse, das gewölbte Bildfeld biegt sich rasch weg</translation></message>
<message><source>Field</source><translation>Feld</translation></message>
<message><source>Field along x</source><translation>Feld entlang x</translation></message>
<message><source>Field angles along y, in degrees: 0; 7; 14. A range: 0:14:5</source><translation>Feldwinkel in y, in Grad: 0; 7; 14. Eine Reihe: 0:14:5</translation></message>
<message><source>Field curvature: where sagittal (S) and tangential (T) rays focus. Distortion: (real − paraxial image height)/paraxial. Thick: exact rays; fine: third order (W22, W20, W11).</source><translation>Bildfeldwölbung: wo sagittale (S) und tangentiale (T) Strahlen zum Fokus kommen. Verzeichnung: (wahre − paraxiale Bildhöhe)/paraxiale. Dick: exakte Strahlen, fein: dritte Ordnung (W22, W20, W11).</translation></message>
<message><source>Field curves</source><translation>Feldkurven</translation></message>
<message><source>Field in x</source><translation>Feld in x</translation></message>
<message><source>Field in x: the field angle along x, for a lens that is not symmetric. The PSF is then drawn with +y pointing away from the axis, turned with its field.</source><translation>Feld in x: der Feldwinkel entlang x, wo das Objektiv nicht symmetrisch ist. Die PSF wird dann mit +y von der Achse weg gezeichnet: gedreht wie ihr Feld.</translation></message>
<message><source>Field map</source><translation>Feldkarte</translation></message>
<message><source>Field map: PSFs all over a 3:2 picture, upright where the panel is, whose corner is the edge of the field, each relative to its own peak and turned with its field. Click a picture, or choose it with the arrow keys and Enter, to go to its field; a frame marks the present one. If the lens is not symmetric, every picture has a field of its own, and you can drag the ring to any field.</source><translation>Feldkarte: die PSF über ein ganzes 3:2-Bild, hochkant, wo die Ansicht es ist, dessen Ecke der Feldrand ist, jede über ihrer eigenen Spitze und gedreht wie ihr Feld. Ein Klick auf ein Bild, oder Pfeiltasten und Enter, gehen zu seinem Feld; ein Rahmen zeigt das jetzige. Wo das Objektiv nicht symmetrisch ist, hat jedes Bild sein eigenes Feld, und der Ring lässt sich zu jedem ziehen.</translation></message>
<message><source>Field point</source><translation>Feldpunkt</translation></message>
<message><source>Field: angle of the chief ray at the entrance pupil; the image height is about f′·tan(field). ▾ marks the fields of the lens file.</source><translation>Feld: Winkel des Hauptstrahls an der Eintrittspupille; die Bildhöhe ist etwa f′·tan(Feld). ▾ sind die Felder, die in der Objektivdatei stehen.</translation></message>
<message><source>Fields in x</source><translation>Felder in x</translation></message>
<message><source>Fields</source><translation>Felder</translation></message>
<message><source>Figures</source><translation>Zahlen</translation></message>
<message><source>Files</source><translation>Dateien</translation></message>
<message><source>Fill factor</source><translation>Füllfaktor</translation></message>
<message><source>Film…</source><translation>Film …</translation></message>
<message><source>Find a command…</source><translation>Befehl finden …</translation></message>
<message><source>Find a lens with the arrow keys or its first letters; Enter opens it. Your own files: Ctrl+O.</source><translation>Pfeiltasten oder die ersten Buchstaben finden ein Objektiv, Enter öffnet es. Eigene Dateien: Strg+O.</translation></message>
<message><source>Find it in two minutes</source><translation>In zwei Minuten gefunden</translation></message>
<message><source>First dark ring of a perfect lens, 0.61 λ/NA.</source><translation>Erster dunkler Ring eines perfekten Objektivs, 0,61 λ/NA.</translation></message>
<message><source>First order</source><translation>Erste Ordnung</translation></message>
<message><source>First-order data</source><translation>Daten erster Ordnung</translation></message>
<message><source>First-order data: everything that follows from paraxial rays alone. Hover over a row for its definition.</source><translation>Daten erster Ordnung: alles, was allein aus paraxialen Strahlen folgt; über einer Zeile steht ihre Definition.</translation></message>
<message><source>Fit departures from the lens on screen; otherwise the lens only sets the scale</source><translation>Abweichungen vom gezeigten Objektiv anpassen; ohne das gibt es nur den Maßstab</translation></message>
<message><source>Focal length f′</source><translation>Brennweite f′</translation></message>
<message><source>Focus</source><translation>Fokus</translation></message>
<message><source>Focus at infinity</source><translation>Auf unendlich einstellen</translation></message>
<message><source>Focus distance</source><translation>Fokus auf</translation></message>
<message><source>Focus distance: the sensor is at the paraxial image of this distance, 1/s′ = 1/f′ − 1/s. Beyond ∞ it is nearer to the lens than the image of infinity. ▾ marks where the source is.</source><translation>Fokus auf: der Sensor steht im paraxialen Bild dieses Abstands, 1/s′ = 1/f′ − 1/s. hinter ∞: näher am Objektiv als das Bild von Unendlich. ▾ zeigt, wo die Quelle steht.</translation></message>
<message><source>Focus: position of the ring that moves groups inside the lens; a focus distance turns it too. ▾ marks the columns of the lens file.</source><translation>Fokus: wo der Ring steht, der Gruppen im Objektiv bewegt; auch ein Fokusabstand dreht ihn. ▾ sind die Spalten der Objektivdatei.</translation></message>
<message><source>Fold or unfold the pupil shape</source><translation>Pupillenform ein- oder ausklappen</translation></message>
<message><source>Forget what was on screen when the explorer ended</source><translation>Vergessen, was beim Ende des Explorers auf dem Bildschirm war</translation></message>
<message><source>Frame</source><translation>Ausschnitt</translation></message>
<message><source>Free pupil</source><translation>Freie Pupille</translation></message>
<message><source>Free pupil: only the six sliders make the wavefront, without the lens's own coefficients.</source><translation>Freie Pupille: allein die sechs Regler machen die Wellenfront, ohne die Koeffizienten des Objektivs.</translation></message>
<message><source>Frequency on the sensor</source><translation>Frequenz auf dem Sensor</translation></message>
<message><source>Fringe, peak waves</source><translation>Fringe, Spitzenwellen</translation></message>
<message><source>From fast to exact</source><translation>Von schnell bis genau</translation></message>
<message><source>From fast to exact: how large an error auto may make, or how long a picture may take. Now: {asked}</source><translation>Von schnell bis genau: welchen Fehler auto machen darf, oder wie lange ein Bild dauern darf. Jetzt: {asked}</translation></message>
<message><source>From the lens: {own}. Added by hand: {added}. Drag the slider to add waves, double-click to remove them; click the number, or press Return, to type it.</source><translation>Vom Objektiv selbst: {own}. Von Hand hinzugefügt: {added}. Ziehen Sie den Regler, um Wellen hinzuzufügen, ein Doppelklick nimmt sie weg; klicken Sie auf die Zahl oder drücken Sie die Eingabetaste, um sie zu tippen.</translation></message>
<message><source>Front focal point, whose light leaves as a parallel beam, from the first vertex: D/C.</source><translation>Objektseitiger Brennpunkt, dessen Licht als paralleles Bündel austritt, vom ersten Scheitel: D/C.</translation></message>
<message><source>Front focus F</source><translation>Objektseitiger Brennpunkt F</translation></message>
<message><source>Front principal plane, imaged onto H′ at magnification 1; from the first vertex.</source><translation>Objektseitige Hauptebene, mit Maßstab 1 auf H′ abgebildet; vom ersten Scheitel.</translation></message>
<message><source>Front-stop landscape singlet</source><translation>Landschaftslinse mit vorderer Blende</translation></message>
<message><source>Gaussian, Moffat</source><translation>Gauß, Moffat</translation></message>
<message><source>Glass</source><translation>Glas</translation></message>
<message><source>Glass or index</source><translation>Glas oder Index</translation></message>
<message><source>Go on</source><translation>Weiter</translation></message>
<message><source>Gram–Schmidt over {percent:.0f} % of the pupil</source><translation>Gram–Schmidt über {percent:.0f} % der Pupille</translation></message>
<message><source>Grey</source><translation>Grau</translation></message>
<message><source>Group of panels</source><translation>Gruppe von Ansichten</translation></message>
<message><source>Handbook</source><translation>Handbuch</translation></message>
<message><source>Handbook: the page of what has the focus</source><translation>Handbuch: die Seite zu dem, was den Fokus hat</translation></message>
<message><source>Help</source><translation>Hilfe</translation></message>
<message><source>Hover or use the arrow keys to look at a place: its PSF and an enlarged detail follow. Drag the split, or move it with Shift and the left or right arrow. Drop a photo here to photograph it through the lens.</source><translation>Zeigen oder mit den Pfeiltasten eine Stelle ansehen: ihre PSF und ihr Ausschnitt folgen. Den Teiler ziehen, oder mit Umschalt und Pfeil links oder rechts bewegen. Ein abgelegtes Foto wird fotografiert.</translation></message>
<message><source>How a lens is judged, in the worst of three fields: axis, seven tenths and edge. The Strehl ratio is that of the peak, as in the other panels.</source><translation>Wonach ein Objektiv beurteilt wird, im schlechtesten von drei Feldern: Achse, sieben Zehntel und Rand. Das Strehl-Verhältnis ist das des Maximums, wie in den anderen Ansichten.</translation></message>
<message><source>Measure six points through this lens whose sensor stands 60 µm too far; the panel finds that</source><translation>Sechs Punkte durch dieses Objektiv messen, dessen Sensor 60 µm zu weit steht; die Ansicht findet das</translation></message>
<message><source>Picture to the edges, or within its axes</source><translation>Bild bis zum Rand oder innerhalb seiner Achsen</translation></message>
<message><source>Show A and B side by side on one scale; zoom and crosshair go together</source><translation>A und B nebeneinander in einem Maßstab zeigen; Zoom und Fadenkreuz gehen gemeinsam</translation></message>
<message><source>Show A, B, A − B, A | B in turn</source><translation>A, B, A − B, A | B der Reihe nach zeigen</translation></message>
<message><source>Try a sample</source><translation>Ein Beispiel versuchen</translation></message>
<message><source>What-if: coefficients altered by hand; of the lens itself remain: {panels}.</source><translation>Was wäre wenn: Koeffizienten von Hand geändert; die des Objektivs selbst bleiben: {panels}.</translation></message>
<message><source>Write the lesson, and begin it in the window</source><translation>Die Lektion schreiben und im Fenster beginnen</translation></message>
<message><source>Zemax, CODE V, OSLO, a table …</source><translation>Zemax, CODE V, OSLO, eine Tabelle …</translation></message>
<message><source>Zooms</source><translation>Zoomt</translation></message>
<message><source>between two positions of the file</source><translation>zwischen zwei Stellungen der Datei</translation></message>
<message><source>higher peak</source><translation>höhere Spitze</translation></message>
<message><source>internal transmittance</source><translation>Reintransmissionsgrad</translation></message>
<message><source>internal transmittance {share:g} of {thickness:g} mm at {wavelength:g} µm; give a share from 0 to 1, a positive thickness and a positive wavelength</source><translation>Reintransmissionsgrad {share:g} von {thickness:g} mm bei {wavelength:g} µm; einen Anteil von 0 bis 1, eine positive Dicke und eine positive Wellenlänge angeben</translation></message>
<message><source>its transmission</source><translation>ihre Durchlässigkeit</translation></message>
<message><source>beyond ∞</source><translation>hinter ∞</translation></message>
<message><source>passes a share of light that changes with the height</source><translation>lässt je nach Höhe verschieden viel Licht durch</translation></message>
<message><source>rays are lost</source><translation>Strahlen gehen verloren</translation></message>
<message><source>At ± this tolerance rays are lost: there is no figure, and the builds are not to be trusted.</source><translation>Bei ± dieser Toleranz gehen Strahlen verloren: Es gibt keine Zahl, und auf die gebauten Objektive ist kein Verlass.</translation></message>
<message><source>By exact rays. The quadratic form by which builds are drawn says {value}: it does not describe so large an error.</source><translation>Aus exakten Strahlen. Die quadratische Form, nach der Objektive gezogen werden, sagt {value}: Einen so großen Fehler beschreibt sie nicht.</translation></message>
<message><source>How many rays come from each point</source><translation>Wie viele Strahlen von jedem Punkt ausgehen</translation></message>
<message><source>How many, evenly spread; this replaces typed values</source><translation>Wie viele, gleichmäßig verteilt; vergisst eingegebene Werte</translation></message>
<message><source>How much farther from the lens the sensor was than in the window.</source><translation>Wie viel weiter vom Objektiv der Sensor stand als im Fenster.</translation></message>
<message><source>How the phase is shown</source><translation>Wie die Phase gezeigt wird</translation></message>
<message><source>How the two pictures are compared</source><translation>Wie die beiden Bilder verglichen werden</translation></message>
<message><source>Hubble Space Telescope as built, f/24</source><translation>Hubble-Weltraumteleskop, wie gebaut, f/24</translation></message>
<message><source>Hubble Space Telescope as designed, f/24</source><translation>Hubble-Weltraumteleskop, wie entworfen, f/24</translation></message>
<message><source>Hybrid achromat f/5, 50 mm: a singlet that diffracts</source><translation>Hybrid-Achromat f/5, 50 mm: eine Einzellinse, die beugt</translation></message>
<message><source>Image</source><translation>Bild</translation></message>
<message><source>Image height</source><translation>Bildhöhe</translation></message>
<message><source>Image: Σ over the scene's points of brightness × PSF at that point, for red, green and blue; distortion and falling light included.</source><translation>Bild: Σ über die Punkte der Szene von Helligkeit × PSF an diesem Punkt, für Rot, Grün und Blau; Verzeichnung und Lichtabfall eingeschlossen.</translation></message>
<message><source>Import</source><translation>Import</translation></message>
<message><source>Import a lens</source><translation>Ein Objektiv importieren</translation></message>
<message><source>Import report</source><translation>Importbericht</translation></message>
<message><source>Import report: what the reader of the lens file took, replaced, ignored or refused, and why.</source><translation>Importbericht: alles, was der Leser der Objektivdatei nahm, ersetzte, überging oder ablehnte, und warum.</translation></message>
<message><source>In a notebook</source><translation>Im Notebook</translation></message>
<message><source>In its own window, or back</source><translation>In einem eigenen Fenster, oder zurück</translation></message>
<message><source>Index behind {surface}</source><translation>Brechzahl hinter {surface}</translation></message>
<message><source>Index: the error of the glass behind this surface, the same at every wavelength.</source><translation>Brechzahl: der Fehler des Glases hinter dieser Fläche, gleich bei jeder Wellenlänge.</translation></message>
<message><source>Inferno</source><translation>Inferno</translation></message>
<message><source>Insert a plane behind this surface; nothing changes until you edit it (Insert)</source><translation>Was dieser Fläche folgt, durch eine Ebene teilen; es ändert sich nichts, bis sie bearbeitet wird (Einfg)</translation></message>
<message><source>Insert after</source><translation>Einfügen danach</translation></message>
<message><source>Inspect</source><translation>Prüfen</translation></message>
<message><source>Install</source><translation>Installieren</translation></message>
<message><source>Irregularity at 45°: the same, raised where x and y are of one sign. Both together are a cylinder in any direction.</source><translation>Passfehler unter 45°: dasselbe, gehoben, wo x und y von einem Vorzeichen sind. Beide zusammen sind ein Zylinder in beliebiger Richtung.</translation></message>
<message><source>Irregularity {surface}</source><translation>Passfehler {surface}</translation></message>
<message><source>Irregularity {surface}, 45°</source><translation>Passfehler {surface}, 45°</translation></message>
<message><source>Irregularity: a cylinder ground into this surface, in fringes (fr.) of 273 nm from the highest to the lowest points of its clear rim. A positive one raises it towards +z along y.</source><translation>Passfehler: ein Zylinder in dieser Fläche, in Ringen von 273 nm zwischen den höchsten und tiefsten Punkten am freien Rand. Ein positiver hebt sie entlang y in Richtung +z.</translation></message>
<message><source>It only moves the image.</source><translation>Sie verschiebt nur das Bild.</translation></message>
<message><source>Its primary is 2.2 µm too flat at the edge: spherical aberration of half a wave RMS in blue</source><translation>Sein Hauptspiegel ist am Rand 2,2 µm zu flach: sphärische Aberration von einer halben Welle RMS im Blauen</translation></message>
<message><source>Keep beside the stage</source><translation>Neben der Bühne behalten</translation></message>
<message><source>Keep in focus: while you edit the lens, the sensor follows its paraxial image, or goes to the smallest RMS of the present point, so that you see the aberrations and not the defocus.</source><translation>Im Fokus halten: während das Objektiv bearbeitet wird, folgt der Sensor seinem paraxialen Bild oder geht zum kleinsten RMS des gegenwärtigen Punkts, damit die Abbildungsfehler zu sehen sind und nicht die Defokussierung.</translation></message>
<message><source>L2 error</source><translation>L2-Fehler</translation></message>
<message><source>Lagrange invariant</source><translation>Lagrange-Invariante</translation></message>
<message><source>Lagrange invariant H = {h} mm</source><translation>Lagrange-Invariante H = {h} mm</translation></message>
<message><source>Landscape</source><translation>Landschaft</translation></message>
<message><source>Language</source><translation>Sprache</translation></message>
<message><source>Larger type</source><translation>Größere Schrift</translation></message>
<message><source>Largest blur diameter on the sensor that is still called sharp.</source><translation>Größter Unschärfedurchmesser auf dem Sensor, der noch scharf heißt.</translation></message>
<message><source>Layout</source><translation>Aufbau</translation></message>
<message><source>Length of the lens with its air: from the first vertex to the sensor.</source><translation>Länge des Objektivs mit seiner Luft: vom ersten Scheitel bis zum Sensor.</translation></message>
<message><source>Lens</source><translation>Objektiv</translation></message>
<message><source>Lens: one row per surface, in the order in which light meets them. Type into a cell; Ctrl+Z undoes it.</source><translation>Objektiv: eine Zeile je Fläche in der Reihenfolge des Lichts; in eine Zelle tippen, Strg+Z nimmt es zurück.</translation></message>
<message><source>Lens…</source><translation>Objektiv …</translation></message>
<message><source>Lesson</source><translation>Lektion</translation></message>
<message><source>Lessons</source><translation>Lernen</translation></message>
<message><source>Let light through evenly</source><translation>Licht gleichmäßig durchlassen</translation></message>
<message><source>Light</source><translation>Hell</translation></message>
<message><source>Link</source><translation>Koppeln</translation></message>
<message><source>Link all</source><translation>Alles koppeln</translation></message>
<message><source>Link none</source><translation>Nichts koppeln</translation></message>
<message><source>Link: {count}</source><translation>Gekoppelt: {count}</translation></message>
<message><source>Lock the colours: other pictures keep the ends of the bar</source><translation>Farben festhalten: andere Bilder behalten die Enden der Farbskala</translation></message>
<message><source>Lock the scale</source><translation>Skala festhalten</translation></message>
<message><source>Lock the scale of this axis (L: all of this plot)</source><translation>Skala dieser Achse festhalten (L: alle dieses Diagramms)</translation></message>
<message><source>Lock the scale of this plot (L)</source><translation>Skala dieses Diagramms festhalten (L)</translation></message>
<message><source>Longitudinal chromatic shift: how far behind the sensor rays of each colour cross the axis: paraxial rays, and exact rays from 0.7 and from the rim of the pupil. Within the band, ±n′λ/(2NA²), diffraction hides it.</source><translation>Farblängsfehler: wie weit hinter dem Sensor Strahlen jeder Farbe die Achse schneiden, paraxiale und exakte aus 0,7 und vom Rand der Pupille. Das Band ist ±n′λ/(2NA²), innerhalb dessen ihn die Beugung verbirgt.</translation></message>
<message><source>MP4 films need imageio-ffmpeg, which is not installed; pip install 'p2sf[mp4]', or choose a GIF</source><translation>MP4-Filme brauchen imageio-ffmpeg, das nicht installiert ist; pip install 'p2sf[mp4]', oder ein GIF wählen</translation></message>
<message><source>MTF</source><translation>MTF</translation></message>
<message><source>MTF of all fields</source><translation>MTF aller Felder</translation></message>
<message><source>MTF of colours and spectrum</source><translation>MTF der Farben und des Spektrums</translation></message>
<message><source>MTF over the field</source><translation>MTF über das Feld</translation></message>
<message><source>MTF through focus</source><translation>MTF durch den Fokus</translation></message>
<message><source>mean of every ring within {percent} %, down to 1e-6 of the peak</source><translation>Mittel jedes Rings auf {percent} %, bis 1e-6 des Maximums</translation></message>
<message><source>MTF: RMS error ≤ {percent} % of its own RMS</source><translation>MTF: RMS-Fehler ≤ {percent} % ihres eigenen RMS</translation></message>
<message><source>MTF: the contrast that remains of a sine pattern, computed by autocorrelation of the pupil, from all light. Grey: the same pupil without aberration. Thin, if something stands in the stop: the clear pupil without aberration.</source><translation>MTF: Kontrast, der von einem Sinusmuster bleibt, Autokorrelation der Pupille über alles Licht, ohne Fenster; grau: dieselbe Pupille ohne Aberration; dünn daneben, wo etwas in der Blende steht: die freie Pupille ohne Aberration.</translation></message>
<message><source>Macro lens f/3.8, 60 mm, with floating focus</source><translation>Makroobjektiv f/3,8, 60 mm, mit gleitender Gruppe</translation></message>
<message><source>Magnification</source><translation>Abbildungsmaßstab</translation></message>
<message><source>Mainly {term}: {percent:.0f} % of the wavefront variance; {other}: {more:.0f} %</source><translation>Am meisten {term}: {percent:.0f} % der Varianz der Wellenfront; {other}: {more:.0f} %</translation></message>
<message><source>Mainly {term}: {percent:.0f} % of the wavefront variance</source><translation>Am meisten {term}: {percent:.0f} % der Varianz der Wellenfront</translation></message>
<message><source>Make no plan; the coarse picture stays</source><translation>Nicht planen; das grobe Bild bleibt</translation></message>
<message><source>Maksutov-Cassegrain f/15, 150 mm</source><translation>Maksutow-Cassegrain f/15, 150 mm</translation></message>
<message><source>Map over depth and field</source><translation>Karte über Abstand und Feld</translation></message>
<message><source>Matrix</source><translation>Matrix</translation></message>
<message><source>Matrix: the same picture at several fields, and at several wavelengths, depths or sensor shifts, or for A and B. Click a picture, or press Enter, to go to its point. A frame marks the present point; a dashed one the nearest to it.</source><translation>Matrix: dasselbe Bild bei mehreren Feldern und mehreren Wellenlängen, Abständen oder Sensorversätzen, oder von A und B. Ein Klick auf ein Bild, oder Enter, macht seinen Punkt zum jetzigen, den ein Rahmen zeigt; gestrichelt: der nächste an ihm.</translation></message>
<message><source>Measure a lens</source><translation>Ein Objektiv vermessen</translation></message>
<message><source>Measured</source><translation>Gemessen</translation></message>
<message><source>Measured: the points of a photograph, the wavefront that explains each of them, with errors, and what all together say about the lens and the position of its sensor. Pictures show the root of brightness relative to the picture's peak, all on one scale.</source><translation>Gemessen: die Punkte einer Aufnahme, die Wellenfront, die jeden erklärt, mit ihren Fehlern, und was alle zusammen über das Objektiv und die Lage des Sensors sagen. Die Bilder zeigen √ der Helligkeit über der Spitze des Bildes, alle auf einer Skala.</translation></message>
<message><source>Noise</source><translation>Rauschen</translation></message>
<message><source>Method</source><translation>Methode</translation></message>
<message><source>Method: what describes the PSF. auto takes the cheapest method whose predicted R² against Huygens is good enough.</source><translation>Methode: was die PSF beschreibt; auto nimmt die billigste, deren vorhergesagtes R² gegen Huygens genügt.</translation></message>
<message><source>Microscope objective 10×, NA 0.25</source><translation>Mikroskopobjektiv 10×, NA 0,25</translation></message>
<message><source>Misalign</source><translation>Dejustieren</translation></message>
<message><source>Misalign: what may be wrong with a built lens, in addition to what its file has. The sensor stays where it is. Choose a piece here, or click it in the layout or the lens table. Decentres are in mm; tilts in degrees, about the piece's first vertex, right-handed. A double-click resets a value.</source><translation>Dejustieren: was an einem gebauten Objektiv nicht stimmen kann, zusätzlich zu dem, was seine Datei hat; der Sensor bleibt, wo er ist. Ein Teil hier wählen, oder im Aufbau oder in der Objektivtabelle anklicken. Dezentrierungen in mm, Kippungen in Grad um den ersten Scheitel des Teils, rechtshändig. Ein Doppelklick setzt eine zurück.</translation></message>
<message><source>Misalignment</source><translation>Dejustierung</translation></message>
<message><source>More</source><translation>Mehr</translation></message>
<message><source>Mostly {term}: {percent:.0f} % of the wavefront variance; {other}: {more:.0f} %</source><translation>Meist {term}: {percent:.0f} % der Varianz der Wellenfront; {other}: {more:.0f} %</translation></message>
<message><source>Mostly {term}: {percent:.0f} % of the wavefront variance</source><translation>Meist {term}: {percent:.0f} % der Varianz der Wellenfront</translation></message>
<message><source>Move the sensor to where the RMS of W over the pupil is smallest (Ctrl+F).</source><translation>Den Sensor dorthin setzen, wo der RMS von W über die Pupille am kleinsten ist (Strg+F).</translation></message>
<message><source>Mute: this term counts as zero (M)</source><translation>Stumm: dieser Term zählt als null (M)</translation></message>
<message><source>Name of the workspace:</source><translation>Name des Arbeitsbereichs:</translation></message>
<message><source>Navarro wide-angle schematic eye, 543 nm</source><translation>Schematisches Weitwinkelauge nach Navarro, 543 nm</translation></message>
<message><source>Next</source><translation>Weiter</translation></message>
<message><source>Next lesson</source><translation>Nächste Lektion</translation></message>
<message><source>Next step of the lesson</source><translation>Nächster Schritt der Lektion</translation></message>
<message><source>No aberration</source><translation>Keine Aberration</translation></message>
<message><source>No plan: these PSFs are too wide</source><translation>Kein Plan: diese PSFs sind zu breit</translation></message>
<message><source>No plan: these pixels hide the PSF</source><translation>Kein Plan: so große Pixel verbergen die PSF</translation></message>
<message><source>No, thanks</source><translation>Nein, danke</translation></message>
<message><source>Nodal point N</source><translation>Knotenpunkt N</translation></message>
<message><source>Nodal point N′</source><translation>Knotenpunkt N′</translation></message>
<message><source>Noll, RMS waves</source><translation>Noll, RMS-Wellen</translation></message>
<message><source>Not measured. A plan follows when the sliders rest.</source><translation>Ungemessen. Wenn die Regler ruhen, folgt ein Plan.</translation></message>
<message><source>Not measured. PSFs as wide as these get no plan: it would take minutes.</source><translation>Ungemessen. Für so breite PSFs wird kein Plan gemacht: er würde Minuten brauchen.</translation></message>
<message><source>Not measured. Pixels as large as these get no plan, since they hide the blur: choose smaller ones.</source><translation>Ungemessen. Für so große Pixel wird kein Plan gemacht, denn sie verbergen, worum es ihm geht: kleinere wählen.</translation></message>
<message><source>Nothing fits; try fewer letters.</source><translation>Nichts passt; weniger Buchstaben versuchen.</translation></message>
<message><source>Nothing is lost: the window is saved as it is now, and the next start shows it again.</source><translation>Nichts ist verloren: Das Fenster ist gespeichert, wie es jetzt ist, und der nächste Start zeigt es wieder.</translation></message>
<message><source>NumPy (*.npz);;TIFF stack for ImageJ (*.tif);;FITS (*.fits);;MATLAB and Octave (*.mat);;Table of figures (*.csv)</source><translation>NumPy (*.npz);;TIFF-Stapel für ImageJ (*.tif);;FITS (*.fits);;MATLAB und Octave (*.mat);;Tabelle der Werte (*.csv)</translation></message>
<message><source>Numerical accuracy</source><translation>Numerische Genauigkeit</translation></message>
<message><source>Numerical aperture</source><translation>Numerische Apertur</translation></message>
<message><source>Nyquist {f}</source><translation>Nyquist {f}</translation></message>
<message><source>OPD fan</source><translation>OPD-Fächer</translation></message>
<message><source>OPD fan: (optical path of the chief ray − that of the ray)/λ for exact rays, including tilt.</source><translation>OPD-Fächer: (optischer Weg des Hauptstrahls − des Strahls)/λ für exakte Strahlen, mit Kippung.</translation></message>
<message><source>OPD, waves</source><translation>OPD, Wellen</translation></message>
<message><source>Object height</source><translation>Objekthöhe</translation></message>
<message><source>Obscuration</source><translation>Abschattung</translation></message>
<message><source>Obscuration in x</source><translation>Abschattung in x</translation></message>
<message><source>Obscuration in y</source><translation>Abschattung in y</translation></message>
<message><source>Obscuration ε: radius of the dark disc in the middle of the stop, as a share of the rim's. It blocks ε² of the light, narrows the core and brightens the rings.</source><translation>Abschattung ε: Radius der dunklen Scheibe in der Mitte der Blende über dem Radius des Randes. Sie nimmt ε² des Lichtes, macht den Kern schmaler und die Ringe heller.</translation></message>
<message><source>Of the aligned lens: its tilts, decentres and irregularities have no part in these sums.</source><translation>Vom gerade gestellten Objektiv: seine Kippungen, Dezentrierungen und Passfehler gehen in diese Summen nicht ein.</translation></message>
<message><source>Of the aligned lens: paraxial rays leave out tilts, decentres and irregularities.</source><translation>Vom gerade gestellten Objektiv: paraxiale Strahlen kennen keine Kippungen, Dezentrierungen und Passfehler.</translation></message>
<message><source>These are the numbers of the lens without its tilts, decentres and irregularities, not of the picture.</source><translation>Das sind die Zahlen des Objektivs ohne seine Kippungen, Dezentrierungen und Passfehler, nicht die des Bildes.</translation></message>
<message><source>Of the whole field, the same at every point.</source><translation>Des ganzen Feldes, an jedem Punkt gleich.</translation></message>
<message><source>Of the whole field: at the farthest point, growing with the distance from the axis.</source><translation>Des ganzen Feldes: am fernsten Punkt, wächst mit dem Abstand von der Achse.</translation></message>
<message><source>Of the whole field: at the farthest point, growing with the square of the distance from the axis.</source><translation>Des ganzen Feldes: am fernsten Punkt, wächst mit dem Quadrat des Abstands von der Achse.</translation></message>
<message><source>On the stage</source><translation>Auf die Bühne</translation></message>
<message><source>One glass with a diffractive side, whose opposite chromatic aberration cancels that of the lens</source><translation>Ein Glas und eine beugende Seite: Ringe, deren Farben umgekehrt laufen, heben die der Linse auf</translation></message>
<message><source>One of the drawn rays does not pass (it misses a surface, or is totally reflected); less light arrives than the picture assumes.</source><translation>Einer der gezeichneten Strahlen kommt nicht durch (Fläche verfehlt oder totale Reflexion); es kommt weniger Licht an, als das Bild annimmt.</translation></message>
<message><source>One scale</source><translation>Ein Maßstab</translation></message>
<message><source>Open</source><translation>Öffnen</translation></message>
<message><source>Open a file…</source><translation>Datei öffnen …</translation></message>
<message><source>Open a lens file or a saved state (Ctrl+O), or a recent one</source><translation>Objektivdatei oder gespeicherten Zustand öffnen (Strg+O), oder eine der letzten</translation></message>
<message><source>Open a lens file or a saved state…</source><translation>Objektivdatei oder gespeicherten Zustand öffnen …</translation></message>
<message><source>Open a lens or a state</source><translation>Objektiv oder Zustand öffnen</translation></message>
<message><source>Open the file with the substitute glasses listed; the lens then counts as edited</source><translation>Die Datei mit den aufgeführten Ersatzgläsern öffnen; das Objektiv gilt dann als bearbeitet</translation></message>
<message><source>Open the lens as its file has it</source><translation>Öffnung wie in der Datei</translation></message>
<message><source>Open this panel in its own window, or put it back (Ctrl+D)</source><translation>Diese Ansicht in einem eigenen Fenster öffnen oder zurückstellen (Strg+D)</translation></message>
<message><source>Overlays</source><translation>Vergleichskurven</translation></message>
<message><source>P2SF Explorer</source><translation>P2SF Explorer</translation></message>
<message><source>P2SF lens (*.toml);;PSF database (*.npz)</source><translation>P2SF-Objektiv (*.toml);;PSF-Datenbank (*.npz)</translation></message>
<message><source>P2SF lens (*.toml);;Zemax (*.zmx);;CODE V (*.seq);;ISET lens (*.json)</source><translation>P2SF-Objektiv (*.toml);;Zemax (*.zmx);;CODE V (*.seq);;ISET-Objektiv (*.json)</translation></message>
<message><source>PCA</source><translation>PCA</translation></message>
<message><source>PSF</source><translation>PSF</translation></message>
<message><source>PSF grid</source><translation>PSF-Gitter</translation></message>
<message><source>PSF, % of the peak</source><translation>PSF, % der Spitze</translation></message>
<message><source>PSF, peak = 1</source><translation>PSF, Spitze = 1</translation></message>
<message><source>PSF, perfect peak = 1</source><translation>PSF, perfekte Spitze = 1</translation></message>
<message><source>PSF, sum = 1</source><translation>PSF, Summe = 1</translation></message>
<message><source>PSF, √</source><translation>PSF, √</translation></message>
<message><source>PSFs</source><translation>PSFs</translation></message>
<message><source>PSFs of this database are predicted to differ from those of exact rays by 1 − R² up to {worst:.1e} {where}, median {median:.1e}; {remedy}</source><translation>PSFs dieser Datenbank weichen nach der Vorhersage um 1 − R² bis {worst:.1e} {where} von denen exakter Strahlen ab, im Median um {median:.1e}; {remedy}</translation></message>
<message><source>PSFs over the field on the stage</source><translation>PSFs über das Feld auf der Bühne</translation></message>
<message><source>PSFs, {wide} µm wide, √ of peak = 1</source><translation>PSFs, {wide} µm breit, √ mit Spitze = 1</translation></message>
<message><source>PSFs, √</source><translation>PSFs, √</translation></message>
<message><source>PSFs, √ of peak = 1</source><translation>PSFs, √ mit Spitze = 1</translation></message>
<message><source>Panel</source><translation>Ansicht</translation></message>
<message><source>Panels</source><translation>Ansichten</translation></message>
<message><source>Panels of the group {group} (Alt+{number})</source><translation>Ansichten der Gruppe {group} (Alt+{number})</translation></message>
<message><source>Paraxial image</source><translation>Paraxiales Bild</translation></message>
<message><source>Paraxial image of this depth, from the last vertex; from the principal points 1/s′ = 1/f′ − 1/s.</source><translation>Paraxiales Bild dieses Abstands, vom letzten Scheitel; von den Hauptpunkten aus 1/s′ = 1/f′ − 1/s.</translation></message>
<message><source>Paste a link</source><translation>Link einfügen</translation></message>
<message><source>Peak of the PSF</source><translation>Spitze der PSF</translation></message>
<message><source>Peak of the PSF over that of the same pupil with W = 0; near 1 it is about exp(−(2πσ)²), σ the RMS of W.</source><translation>Spitze der PSF über der derselben Pupille mit W = 0; nahe 1 etwa exp(−(2πσ)²), σ der RMS von W.</translation></message>
<message><source>Peak waves ± one standard deviation; in brackets those of the lens at the f-number found.</source><translation>Wellen (Spitze) ± eine Standardabweichung; in Klammern die des Objektivs bei der gefundenen Blendenzahl.</translation></message>
<message><source>Perfect lens</source><translation>Ideale Linse</translation></message>
<message><source>Periskop-type symmetric lens, f/11, 100 mm</source><translation>Symmetrisches Objektiv vom Periskop-Typ, f/11, 100 mm</translation></message>
<message><source>Petzval lens f/1.4, 50 mm</source><translation>Petzval-Objektiv f/1,4, 50 mm</translation></message>
<message><source>Petzval radius</source><translation>Petzval-Radius</translation></message>
<message><source>Petzval sum</source><translation>Petzvalsumme</translation></message>
<message><source>Phone camera lens f/2.8, 3.6 mm</source><translation>Objektiv einer Telefonkamera f/2,8, 3,6 mm</translation></message>
<message><source>Photo…</source><translation>Foto …</translation></message>
<message><source>Picture (*.png)</source><translation>Bild (*.png)</translation></message>
<message><source>Picture (*.png);;glTF scene (*.gltf);;OBJ scene (*.obj)</source><translation>Bild (*.png);;glTF-Szene (*.gltf);;OBJ-Szene (*.obj)</translation></message>
<message><source>Picture before and after the lens; arrow keys move the place you look at, with Shift the split</source><translation>Bild vor und hinter dem Objektiv; Pfeile verschieben den betrachteten Ort, mit Umschalt die Teilung</translation></message>
<message><source>Picture of one panel</source><translation>Bild einer Ansicht</translation></message>
<message><source>Pictures (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.heic *.heif)</source><translation>Bilder (*.png *.tif *.tiff *.exr *.jpg *.jpeg *.heic *.heif)</translation></message>
<message><source>Pictures (*.png *.tif *.tiff)</source><translation>Bilder (*.png *.tif *.tiff)</translation></message>
<message><source>Pictures of points (*.png *.tif *.tiff *.jpg *.jpeg *.fits *.fit *.npy *.npz *.txt)</source><translation>Bilder von Punkten (*.png *.tif *.tiff *.jpg *.jpeg *.fits *.fit *.npy *.npz *.txt)</translation></message>
<message><source>Picture…</source><translation>Bild …</translation></message>
<message><source>Pin a marker here</source><translation>Hier eine Marke setzen</translation></message>
<message><source>Pin what is on screen as B, or take B away</source><translation>Das Gezeigte als B merken, oder B entfernen</translation></message>
<message><source>Pin what is on screen as B, to compare with it, or unpin it (Ctrl+B)</source><translation>Das Gezeigte als B merken, um damit zu vergleichen, oder B entfernen (Strg+B)</translation></message>
<message><source>Pixel</source><translation>Pixel</translation></message>
<message><source>Pixel pitch</source><translation>Pixelabstand</translation></message>
<message><source>Pixel pitch of the picture; listings and PSFs of this program state theirs</source><translation>Pixelabstand des Bildes; Listen und PSFs dieses Programms nennen ihren eigenen</translation></message>
<message><source>Pixel pitch of the sensor.</source><translation>Pixelabstand des Sensors.</translation></message>
<message><source>Pixel pitch of the sensor; its Nyquist frequency is 1/(2 pitch).</source><translation>Pixelabstand des Sensors; seine Nyquist-Frequenz ist 1/(2 Abstand).</translation></message>
<message><source>Pixels a side</source><translation>Pixel je Seite</translation></message>
<message><source>Pixels along each side of every PSF; auto fits the widest one</source><translation>Pixel entlang jeder Seite jeder PSF; auto fasst die breiteste</translation></message>
<message><source>Pixels at the field point, or the field</source><translation>Pixel am Feldpunkt, oder das Feld</translation></message>
<message><source>Places</source><translation>Orte</translation></message>
<message><source>Plan it after all</source><translation>Doch noch planen</translation></message>
<message><source>Plano-convex singlet, 25.4 mm, N-SF11 (stock lens)</source><translation>Plankonvexe Einzellinse, 25,4 mm, N-SF11 (Lagerware)</translation></message>
<message><source>Plans</source><translation>Pläne</translation></message>
<message><source>Play or pause (Space on a slider)</source><translation>Abspielen oder anhalten (Leertaste auf einem Regler)</translation></message>
<message><source>Play or pause the last slider</source><translation>Letzten Regler abspielen oder anhalten</translation></message>
<message><source>Plot</source><translation>Diagramm</translation></message>
<message><source>Plot: {left} over {bottom}</source><translation>Diagramm: {left} über {bottom}</translation></message>
<message><source>Point spread function: the light of one point source on the sensor, |FT{P}|² of the pupil P = A·exp(i2πW).</source><translation>Punktbildfunktion: das Licht einer Punktquelle auf dem Sensor, |FT{P}|² der Pupille P = A·exp(i2πW).</translation></message>
<message><source>Points</source><translation>Punkte</translation></message>
<message><source>Pop out</source><translation>Lösen</translation></message>
<message><source>Position of the sensor from the last vertex: at the image of the focus distance, shifted by Δz.</source><translation>Wo der Sensor steht, vom letzten Scheitel: im Bild des eingestellten Abstands, um Δz verschoben.</translation></message>
<message><source>Preparing the 3D view; this takes some seconds, once.</source><translation>Die 3D-Ansicht wird vorbereitet: das Laden dauert einmal einige Sekunden.</translation></message>
<message><source>Present: the stage on the full screen, or back (Esc)</source><translation>Vorführen: die Bühne auf dem ganzen Bildschirm, oder zurück (Esc)</translation></message>
<message><source>Preset</source><translation>Vorgabe</translation></message>
<message><source>Presets</source><translation>Vorgaben</translation></message>
<message><source>Previous step of the lesson</source><translation>Voriger Schritt der Lektion</translation></message>
<message><source>Principal point H</source><translation>Hauptpunkt H</translation></message>
<message><source>Principal point H′</source><translation>Hauptpunkt H′</translation></message>
<message><source>Print</source><translation>Druckseite</translation></message>
<message><source>Profiles</source><translation>Profile</translation></message>
<message><source>Pupil</source><translation>Pupille</translation></message>
<message><source>Pupil as the lens file has it</source><translation>Pupille wie in der Objektivdatei</translation></message>
<message><source>Pupil shape</source><translation>Pupillenform</translation></message>
<message><source>Pupils</source><translation>Pupillen</translation></message>
<message><source>Put the source at infinity</source><translation>Die Quelle ins Unendliche setzen</translation></message>
<message><source>Put the sweep away</source><translation>Durchlauf wegräumen</translation></message>
<message><source>Put this panel on the stage (double-click its title, or drag it there)</source><translation>Diese Ansicht auf die Bühne stellen (Doppelklick auf den Titel, oder dorthin ziehen)</translation></message>
<message><source>Qbfs asphere</source><translation>Qbfs-Asphäre</translation></message>
<message><source>Qcon asphere</source><translation>Qcon-Asphäre</translation></message>
<message><source>Qt needs the library libxcb-cursor to open a window on X11; run apt-get install libxcb-cursor0</source><translation>Qt braucht die Bibliothek libxcb-cursor, um auf X11 ein Fenster zu öffnen; apt-get install libxcb-cursor0 ausführen</translation></message>
<message><source>R80 {radius} µm</source><translation>R80 {radius} µm</translation></message>
<message><source>R80 {radius} µm (of {percent:.0f} % in view)</source><translation>R80 {radius} µm (von {percent:.0f} % im Bild)</translation></message>
<message><source>R80: error ≤ {percent} % of R80, by a bound</source><translation>R80: Fehler ≤ {percent} % von R80, nach einer Schranke</translation></message>
<message><source>RMS in x</source><translation>RMS in x</translation></message>
<message><source>RMS in y</source><translation>RMS in y</translation></message>
<message><source>RMS radius</source><translation>RMS-Radius</translation></message>
<message><source>RMS wavefront {value} λ</source><translation>RMS-Wellenfront {value} λ</translation></message>
<message><source>RMS wavefront, waves</source><translation>RMS-Wellenfront, Wellen</translation></message>
<message><source>RMS {rms} λ</source><translation>RMS {rms} λ</translation></message>
<message><source>RMS {r} λ</source><translation>RMS {r} λ</translation></message>
<message><source>RMS {r} λ · PV {p} λ</source><translation>RMS {r} λ · PV {p} λ</translation></message>
<message><source>RMS {value} µm</source><translation>RMS {value} µm</translation></message>
<message><source>RMS ≤ {limit} λ</source><translation>RMS ≤ {limit} λ</translation></message>
<message><source>RMS, waves</source><translation>RMS, Wellen</translation></message>
<message><source>RMS, λ</source><translation>RMS, λ</translation></message>
<message><source>Radius of curvature, mm: positive when the centre lies to the right; ∞ is a plane.</source><translation>Krümmungsradius, mm: positiv, wenn der Mittelpunkt rechts liegt; ∞ ist eine Ebene.</translation></message>
<message><source>Radius {surface}</source><translation>Radius {surface}</translation></message>
<message><source>Radius, mm</source><translation>Radius, mm</translation></message>
<message><source>Radius: its error in percent; fringes (fr.) are those of a test plate of the right radius.</source><translation>Radius: sein Fehler in Prozent; die Ringe sind die eines Probeglases mit dem richtigen Radius.</translation></message>
<message><source>Rail at the right or at the bottom</source><translation>Ansichten neben der Bühne rechts oder unten</translation></message>
<message><source>Ray fan</source><translation>Strahlfächer</translation></message>
<message><source>Ray fan: how far an exact ray lands from the chief ray, against its place in the pupil.</source><translation>Strahlfächer: wie weit vom Hauptstrahl ein exakter Strahl landet, über seinem Ort in der Pupille.</translation></message>
<message><source>Rays</source><translation>Strahlen</translation></message>
<message><source>Rays coloured by kind, or from every field or at every wavelength of the lens</source><translation>Strahlen nach ihrer Art gefärbt, oder von jedem Feld oder bei jeder Wellenlänge, die das Objektiv nennt</translation></message>
<message><source>Rays fill</source><translation>Strahlen füllen</translation></message>
<message><source>Rays fill: the real stop, as light does, or the paraxial entrance pupil, as in the paper and by default in most programs. The two differ off axis and in fast lenses.</source><translation>Strahlen füllen: die wahre Blende, wie es das Licht tut, oder die paraxiale Eintrittspupille, die übliche Wahl des Artikels und der meisten Programme. Außer der Achse und in lichtstarken Objektiven unterscheiden sich beide.</translation></message>
<message><source>Rays within the rims</source><translation>Strahlen in den Rändern</translation></message>
<message><source>Rear focal point, where light from a far axial point meets, from the last vertex: f′·A.</source><translation>Bildseitiger Brennpunkt, wo sich das Licht eines fernen Achspunkts trifft, vom letzten Scheitel: f′·A.</translation></message>
<message><source>Rear principal plane, from which f′ is measured to F′; from the last vertex.</source><translation>Bildseitige Hauptebene, von der f′ bis F′ zählt; vom letzten Scheitel.</translation></message>
<message><source>Rear-stop landscape singlet</source><translation>Landschaftslinse mit hinterer Blende</translation></message>
<message><source>Redo</source><translation>Wiederholen</translation></message>
<message><source>Redo: take the step again (Ctrl+Shift+Z)</source><translation>Wiederholen: den Schritt noch einmal tun (Strg+Umschalt+Z)</translation></message>
<message><source>Refocusing would remove {percent:.0f} % of the wavefront variance</source><translation>Nachfokussieren nähme {percent:.0f} % der Varianz der Wellenfront weg</translation></message>
<message><source>Relay of two achromats, stop between, inverted pupils (synthetic; finite objects only)</source><translation>Relais aus zwei Achromaten, Blende dazwischen, umgekehrte Pupillen (synthetisch; nur endliche Objekte)</translation></message>
<message><source>Remove the markers</source><translation>Marken entfernen</translation></message>
<message><source>Remove this surface; the others stay where they are (Delete)</source><translation>Diese Fläche herausnehmen; die anderen bleiben, wo sie sind (Entf)</translation></message>
<message><source>Report</source><translation>Bericht</translation></message>
<message><source>Report, command palette, colours, theme, language</source><translation>Bericht, Befehlspalette, Farben, Aussehen, Sprache</translation></message>
<message><source>Replace</source><translation>Ersetzen</translation></message>
<message><source>Reset</source><translation>Nullen</translation></message>
<message><source>Reset all</source><translation>Alles zurücksetzen</translation></message>
<message><source>Reset all errors of the lens</source><translation>Jede Zahl des Objektivs wieder richtig stellen</translation></message>
<message><source>Reset all errors of this piece</source><translation>Jede Zahl dieses Teils wieder richtig stellen</translation></message>
<message><source>Reset piece</source><translation>Teil zurücksetzen</translation></message>
<message><source>Reset this error</source><translation>Diese Zahl wieder richtig stellen</translation></message>
<message><source>Restore the pupil of the lens file</source><translation>In die Blende setzen, was die Objektivdatei dort hat</translation></message>
<message><source>Resume the plan that was cancelled, and make its picture</source><translation>Den abgebrochenen Plan doch machen und das Bild danach</translation></message>
<message><source>Retrofocus wide angle f/2, 35 mm, 63 degree field</source><translation>Retrofokus-Weitwinkel f/2, 35 mm, 63 Grad Feld</translation></message>
<message><source>Return the sensor to where the lens file has it</source><translation>Den Sensor dorthin setzen, wo ihn die Datei hat</translation></message>
<message><source>Reverse telephoto f/6.7, 60 degree field (f = 2)</source><translation>Umgekehrtes Teleobjektiv f/6,7, 60 Grad Feld (f = 2)</translation></message>
<message><source>Roundness</source><translation>Rundung</translation></message>
<message><source>Roundness of the blades' edges: their curvature times the rim's radius, 0 straight, 1 a circle.</source><translation>Rundung der Lamellenkanten: ihre Krümmung mal dem Radius des Randes, 0 gerade, 1 ein Kreis.</translation></message>
<message><source>R²</source><translation>R²</translation></message>
<message><source>R² compares with the Huygens sum of exact rays, or with spherical waves from the exit pupil where plane ones miss those by more than 0.001; it is predicted until that sum is done, then measured.</source><translation>R² vergleicht mit der Huygens-Summe exakter Strahlen, oder mit Kugelwellen aus der Austrittspupille, wo ebene Wellen diese um mehr als 0,001 verfehlen; es ist vorhergesagt, bis diese Summe fertig ist, dann gemessen.</translation></message>
<message><source>R² not predicted</source><translation>R² nicht vorhergesagt</translation></message>
<message><source>R² {r} vs Huygens</source><translation>R² {r} gegen Huygens</translation></message>
<message><source>R² {r} vs spherical waves</source><translation>R² {r} gegen Kugelwellen</translation></message>
<message><source>R² ≥ {r2} against Huygens</source><translation>R² ≥ {r2} gegen Huygens</translation></message>
<message><source>R² ≥ {value:g}</source><translation>R² ≥ {value:g}</translation></message>
<message><source>Sampling</source><translation>Abtastung</translation></message>
<message><source>Save a film</source><translation>Film speichern</translation></message>
<message><source>Save a film of the first forty of these builds: layout, PSF, and where each stands in the yield</source><translation>Einen Film der ersten vierzig dieser Exemplare speichern: Aufbau, PSF und wo jedes in der Ausbeute steht</translation></message>
<message><source>Save a snapshot</source><translation>Schnappschuss speichern</translation></message>
<message><source>Save as…</source><translation>Speichern als …</translation></message>
<message><source>Save lens as…</source><translation>Objektiv speichern als …</translation></message>
<message><source>Save the 3D view</source><translation>3D-Ansicht speichern</translation></message>
<message><source>Save the lens</source><translation>Objektiv speichern</translation></message>
<message><source>Save the lens as .toml, .zmx, .seq or ISET .json (Ctrl+Shift+S)</source><translation>Das Objektiv als .toml, .zmx, .seq oder ISET-.json speichern (Strg+Umschalt+S)</translation></message>
<message><source>Save the lens as built</source><translation>Das Objektiv speichern, wie es gebaut ist</translation></message>
<message><source>Save the lens as it is now…</source><translation>Objektiv speichern, wie es jetzt ist …</translation></message>
<message><source>Save the measurement</source><translation>Die Messung speichern</translation></message>
<message><source>Save the numbers and their errors as .npz</source><translation>Die Zahlen und ihre Fehler als .npz speichern</translation></message>
<message><source>Save the picture</source><translation>Das Bild speichern</translation></message>
<message><source>Save the picture as PNG or TIFF, with the state in it</source><translation>Das Bild als PNG oder TIFF speichern, mit dem Zustand darin</translation></message>
<message><source>Save the report</source><translation>Bericht speichern</translation></message>
<message><source>Save the sweep from the first value to the last as a film</source><translation>Den Weg vom ersten bis zum letzten Wert als Film speichern</translation></message>
<message><source>Save the view as a picture, or the scene as glTF or OBJ</source><translation>Die Ansicht als Bild oder die Szene als glTF oder OBJ speichern</translation></message>
<message><source>Save the workspace</source><translation>Arbeitsbereich speichern</translation></message>
<message><source>Save this lens with the sensor where the picture shows it to be, or its PSF database</source><translation>Dieses Objektiv mit dem Sensor dort speichern, wo er nach dem Bild steht, oder seine PSF-Datenbank</translation></message>
<message><source>Saved {count} frames, {first} to {last}</source><translation>{count} Bilder gespeichert, {first} bis {last}</translation></message>
<message><source>Saved {name}</source><translation>{name} gespeichert</translation></message>
<message><source>Saved {name}, and its state as {beside}</source><translation>{name} gespeichert, sein Zustand als {beside}</translation></message>
<message><source>Saved {name}, with the state in it</source><translation>{name} gespeichert, mit dem Zustand darin</translation></message>
<message><source>the lens takes {size:.3g} MB of text, of which {most:g} MB can be kept with what is on screen; save the lens as a file (Ctrl+Shift+S) and open that</source><translation>das Objektiv braucht {size:.3g} MB Text, von denen {most:g} MB mit dem Bildschirm gesichert werden können; das Objektiv als Datei speichern (Strg+Umschalt+S) und diese öffnen</translation></message>
<message><source>{name} is there already. Replace it?</source><translation>{name} gibt es schon. Ersetzen?</translation></message>
<message><source>{path} is open, and what is on screen would be lost with it; choose another name</source><translation>{path} ist geöffnet, und was zu sehen ist, ginge mit verloren; einen anderen Namen wählen</translation></message>
<message><source>{path} is there already and is no state of the explorer; choose another name, or move that file</source><translation>{path} gibt es schon und ist kein Zustand des Explorers; einen anderen Namen wählen oder diese Datei verschieben</translation></message>
<message><source>{path} is there already and is not of this program; move it, or choose another name</source><translation>{path} gibt es schon und ist nicht von diesem Programm; die Datei verschieben oder einen anderen Namen wählen</translation></message>
<message><source>give the name of a file</source><translation>den Namen einer Datei angeben</translation></message>
<message><source>{path} cannot be written, there is no room for it in the folder of temporary files ({reason}); free some space there, or name another folder in TMPDIR</source><translation>{path} kann nicht geschrieben werden, im Ordner für vorläufige Dateien ist kein Platz ({reason}); dort Platz schaffen oder in TMPDIR einen anderen Ordner nennen</translation></message>
<message><source>{path} had another name (a hard link), under which the old contents stay; copy the new file there if it is to follow</source><translation>{path} hatte einen zweiten Namen (einen harten Link), unter dem der alte Inhalt bleibt; die neue Datei dorthin kopieren, wenn er folgen soll</translation></message>
<message><source>Save…</source><translation>Speichern …</translation></message>
<message><source>Schmidt camera f/3, 80 mm</source><translation>Schmidt-Kamera f/3, 80 mm</translation></message>
<message><source>Sections of the PSF through the chief ray, relative to its peak; grey: the Airy pattern (2J₁(v)/v)². Beside or below: encircled energy, the share of all light within a radius of the centroid; grey: a perfect lens. If something stands in the stop, the perfect lens has the same pupil, and a thin curve is for the clear one. The RMS radius is that of the rays, since that of diffracted light is infinite.</source><translation>Schnitte der PSF durch den Hauptstrahl, auf ihren eigenen Spitzenwert bezogen; grau: das Airy-Muster (2J₁(v)/v)². Daneben oder darunter: umschlossene Energie, der Anteil allen Lichts innerhalb eines Radius um seinen Schwerpunkt; grau: eine ideale Linse, mit etwas in der Blende die derselben Pupille, und dünn die der freien. Der RMS-Radius ist der der Strahlen: das Licht hinter einem harten Rand hat keinen.</translation></message>
<message><source>Seidel and chromatic sums: what each surface adds, in waves at the rim of the pupil; large ones of opposite sign cancel. C I and C II: defocus and tilt of the lens's shortest wavelength minus those of its longest. Point at a bar to highlight its surface in the layout, or at a surface to highlight its bar.</source><translation>Seidel- und Farbsummen: was jede Fläche beiträgt, in Wellen am Pupillenrand; große mit entgegengesetztem Vorzeichen heben sich auf. C I und C II: Defokus und Verkippung der kürzesten Wellenlänge des Objektivs minus die der längsten. Auf einen Balken zeigen: seine Fläche leuchtet im Aufbau, und umgekehrt.</translation></message>
<message><source>Seidel is of the aligned lens; the other methods include its tilts, decentres and irregularities.</source><translation>Seidel gilt für das gerade gestellte Objektiv; die anderen Methoden kennen seine Kippungen, Dezentrierungen und Passfehler.</translation></message>
<message><source>Seidel per surface</source><translation>Seidel je Fläche</translation></message>
<message><source>Semi-diameter, mm</source><translation>Halbmesser, mm</translation></message>
<message><source>Sensor</source><translation>Sensor</translation></message>
<message><source>Sensor position</source><translation>Sensorort</translation></message>
<message><source>Sensor shift</source><translation>Sensorversatz</translation></message>
<message><source>Sensor shift Δz away from the lens, in addition to focus; it adds the defocus Wd = NA²Δz/(2n′λ).</source><translation>Sensorversatz Δz weg vom Objektiv, zusätzlich zur Einstellung; er fügt den Defokus Wd = NA²Δz/(2n′λ) hinzu.</translation></message>
<message><source>Sensor − image</source><translation>Sensor − Bild</translation></message>
<message><source>Set of PSFs…</source><translation>Satz PSFs …</translation></message>
<message><source>Share of a pixel's area that is sensitive: a square in its middle</source><translation>Wie viel der Fläche eines Pixels empfindlich ist: ein Quadrat in seiner Mitte</translation></message>
<message><source>Share of the traced rays that pass every rim and arrive.</source><translation>Die jeden Rand passieren und ankommen, von den verfolgten.</translation></message>
<message><source>Sharpening</source><translation>Schärfung</translation></message>
<message><source>Shift, Alt</source><translation>Umschalt, Alt</translation></message>
<message><source>Shifts</source><translation>Versatz</translation></message>
<message><source>Shipped lenses</source><translation>Mitgelieferte Objektive</translation></message>
<message><source>Shortcuts</source><translation>Tastenkürzel</translation></message>
<message><source>Shortcuts and mouse (Shift+F1 or ?)</source><translation>Tastenkürzel und Maus (Umschalt+F1 oder ?)</translation></message>
<message><source>Shorter than its focal length: a positive group in front, a negative one behind</source><translation>Kürzer als seine Brennweite: vorn eine sammelnde Gruppe, dahinter eine zerstreuende</translation></message>
<message><source>Show A − B; a panel in which a difference means nothing shows A and says why</source><translation>A − B zeigen; eine Ansicht, in der eine Differenz nichts bedeutet, zeigt A und sagt, warum</translation></message>
<message><source>Show A, which the controls move</source><translation>A zeigen, das die Regler bewegen</translation></message>
<message><source>Show B, as it was pinned</source><translation>B zeigen, wie es gemerkt wurde</translation></message>
<message><source>Show a slider for the field along x even if the lens is symmetric</source><translation>Ein Regler für das Feld entlang x auch dort, wo das Objektiv symmetrisch ist</translation></message>
<message><source>Show or hide the controls</source><translation>Regler zeigen oder verbergen</translation></message>
<message><source>Show or hide what stands beside the stage</source><translation>Zeigen oder verbergen, was neben der Bühne steht</translation></message>
<message><source>Show the answer</source><translation>Antwort zeigen</translation></message>
<message><source>Show the answer (Alt+Down)</source><translation>Antwort zeigen (Alt+Abwärts)</translation></message>
<message><source>Show the fitted pupil of this point in the window, as a free pupil; undo returns to the lens</source><translation>Die angepasste Pupille dieses Punktes im Fenster zeigen, als freie Pupille; Rückgängig holt das Objektiv zurück</translation></message>
<message><source>Show the window as it was; Ctrl+Z returns to this one</source><translation>Das Fenster zeigen, wie es war; Strg+Z kehrt zu diesem zurück</translation></message>
<message><source>Siemens star</source><translation>Siemensstern</translation></message>
<message><source>Six coefficients are those of the aligned lens, without its tilts, decentres and irregularities; choose auto, fitted or traced to see what these do.</source><translation>Die sechs Koeffizienten sind die des gerade gestellten Objektivs, ohne seine Kippungen, Dezentrierungen und Passfehler; auto, fitted oder traced wählen, um zu sehen, was diese tun.</translation></message>
<message><source>Slanted edge</source><translation>Schräge Kante</translation></message>
<message><source>Smaller type</source><translation>Kleinere Schrift</translation></message>
<message><source>Snapshot</source><translation>Sichern</translation></message>
<message><source>Solo: only this term counts (S)</source><translation>Solo: nur dieser Term zählt (S)</translation></message>
<message><source>Spectrum</source><translation>Spektrum</translation></message>
<message><source>Speed</source><translation>Geschwindigkeit</translation></message>
<message><source>Spherical, 1 λ, best focus</source><translation>Sphärisch, 1 λ, bester Fokus</translation></message>
<message><source>Spherical, 1 λ, marginal focus</source><translation>Sphärisch, 1 λ, Randfokus</translation></message>
<message><source>Spherical, 1 λ, paraxial focus</source><translation>Sphärisch, 1 λ, paraxialer Fokus</translation></message>
<message><source>Spot</source><translation>Spot</translation></message>
<message><source>Spot diagram: where exact rays, evenly spread over the pupil, meet the sensor; no diffraction.</source><translation>Spotdiagramm: wo exakte, über die Pupille gleichmäßig verteilte Strahlen auf den Sensor treffen; ohne Beugung.</translation></message>
<message><source>State only…</source><translation>Nur Zustand …</translation></message>
<message><source>Steps</source><translation>Schritte</translation></message>
<message><source>Stop</source><translation>Blende</translation></message>
<message><source>Stop filming and leave no file</source><translation>Aufnahme abbrechen und keine Datei hinterlassen</translation></message>
<message><source>Stop measuring</source><translation>Das Messen anhalten</translation></message>
<message><source>Stop radius</source><translation>Blendenradius</translation></message>
<message><source>Stop shift: distance of the stop behind the surface before it, within its air gap; the f-number does not change.</source><translation>Blendenverschiebung: der Abstand der Blende hinter der Fläche davor, in ihrem Luftabstand; die Blendenzahl bleibt.</translation></message>
<message><source>Stop the computation</source><translation>Die Rechnung anhalten</translation></message>
<message><source>Stop: the surface whose rim limits the light, as named by the lens file or found as the smallest |rim/y|.</source><translation>Blende: die Fläche, deren Rand das Licht begrenzt; in der Datei genannt, oder gefunden als kleinstes |Rand/y|.</translation></message>
<message><source>Stopped. Draw again to start over.</source><translation>Angehalten. Neu ziehen beginnt von vorn.</translation></message>
<message><source>Strehl</source><translation>Strehl</translation></message>
<message><source>Strehl ratio</source><translation>Strehl-Zahl</translation></message>
<message><source>Strehl ratio {value}</source><translation>Strehl-Verhältnis {value}</translation></message>
<message><source>Strehl ratio ≥ {limit}</source><translation>Strehl-Verhältnis ≥ {limit}</translation></message>
<message><source>Strehl {strehl}</source><translation>Strehl {strehl}</translation></message>
<message><source>Strehl {value}</source><translation>Strehl {value}</translation></message>
<message><source>Surfaces of the lens</source><translation>Flächen des Objektivs</translation></message>
<message><source>Swap</source><translation>Tauschen</translation></message>
<message><source>Sweep</source><translation>Durchlauf</translation></message>
<message><source>Tab, Shift+Tab</source><translation>Tab, Umschalt+Tab</translation></message>
<message><source>Table</source><translation>Tabelle</translation></message>
<message><source>Take B away (Ctrl+B)</source><translation>B entfernen (Strg+B)</translation></message>
<message><source>Take the lens as measured into the window and sharpen photos that it took; undo brings the lens back</source><translation>Das Objektiv, wie gemessen, ins Fenster übernehmen und Fotos schärfen, die es aufgenommen hat; Rückgängig bringt das Objektiv zurück</translation></message>
<message><source>Teach</source><translation>Lehren</translation></message>
<message><source>Telecentric relay 1:1, NA 0.05 (finite objects only)</source><translation>Telezentrisches Übertragungsobjektiv 1:1, NA 0,05 (nur für nahe Objekte)</translation></message>
<message><source>Telephoto f/5.6, 127 mm</source><translation>Teleobjektiv f/5,6, 127 mm</translation></message>
<message><source>Tessar f/4.5 (unit scale, f = 4 in)</source><translation>Tessar f/4,5 (Einheitsmaßstab, f = 4 Zoll)</translation></message>
<message><source>Text of the lesson</source><translation>Text der Lektion</translation></message>
<message><source>Textbook wavefronts, in a free pupil</source><translation>Wellenfronten aus dem Lehrbuch, in freier Pupille</translation></message>
<message><source>The PSF on the stage; layout, coefficients and profiles beside it</source><translation>Die PSF auf der Bühne; Aufbau, Koeffizienten und Profile daneben</translation></message>
<message><source>The PSF, the Airy pattern of a perfect lens of this aperture (each relative to its own peak), and the PSF integrated over square pixels, the middle one centred on the chief ray.</source><translation>Die PSF, das Airy-Muster einer idealen Linse dieser Öffnung (jede über ihrer eigenen Spitze) und die PSF, über quadratische Pixel summiert; das mittlere liegt um den Hauptstrahl.</translation></message>
<message><source>The achromat's plain companion: same focal length and aperture, one glass</source><translation>Das schlichte Gegenstück zum Achromaten: gleiche Brennweite und Öffnung, ein Glas</translation></message>
<message><source>The blur is so large that the picture is ray density, no diffraction; {remedy}.</source><translation>Die Unschärfe ist so groß, dass das Bild die Strahlendichte ohne Beugung ist; {remedy}.</translation></message>
<message><source>The complete trade has been measured for shipped lenses only</source><translation>Der vollständige Vergleich ist nur für die mitgelieferten Objektive gemessen</translation></message>
<message><source>The distance between pixels, µm</source><translation>Der Abstand der Pixel, µm</translation></message>
<message><source>The explorer did not close properly. What was on screen, {lens} on {when}, has been kept.</source><translation>Der Explorer ist nicht ordentlich zu Ende gegangen. Was auf dem Bildschirm war, {lens} am {when}, ist aufgehoben.</translation></message>
<message><source>The explorer has made a mistake.</source><translation>Der Explorer hat einen Fehler gemacht.</translation></message>
<message><source>The figures below and the sentence above are those of A, which the controls move.</source><translation>Die Zahlen darunter und der Satz darüber gehören zu A, das die Regler bewegen.</translation></message>
<message><source>The first picture is being made …</source><translation>Das erste Bild entsteht …</translation></message>
<message><source>The human eye, 60 dioptres, with its image in the vitreous (n' = 1.3377)</source><translation>Das menschliche Auge, 60 Dioptrien, mit dem Bild im Glaskörper (n' = 1,3377)</translation></message>
<message><source>The interpolation whose error is shown</source><translation>Zu welcher Interpolation der Fehler gehört</translation></message>
<message><source>The layout on the stage; lens table and PSF below</source><translation>Der Aufbau auf der Bühne; Objektivtabelle und PSF darunter</translation></message>
<message><source>The lens differs from its file; save it from the lens table (Ctrl+Shift+S)</source><translation>Das Objektiv weicht von seiner Datei ab; speichern in der Objektivtabelle (Strg+Umschalt+S)</translation></message>
<message><source>The lens in space; arrow keys turn it, + and − zoom</source><translation>Das Objektiv im Raum; Pfeiltasten drehen, + und − vergrößern und verkleinern</translation></message>
<message><source>The lens to scale. The stop limits the cone of light; the lens images it into the pupils EnP and ExP. With Clip at rims, a ray ends with a bar at the rim that stops it. Drag the source, the sensor or the stop; click glass, then drag it, its edges or its vertices.</source><translation>Das Objektiv maßstäblich: Die Blende begrenzt den Lichtkegel; ihre Bilder durch das Objektiv sind die Pupillen EnP und ExP. Mit Randbeschnitt endet ein Strahl mit einem Balken am Rand, der ihn aufhält. Ziehen Sie Quelle, Sensor oder Blende; klicken Sie Glas an und ziehen Sie dann an ihm, seinen Rändern oder Scheiteln.</translation></message>
<message><source>The limit that a good lens meets in every field; at first, the one that four lenses of five meet.</source><translation>Was jedes Feld eines guten Objektivs einhält; anfangs, was vier von fünf Objektiven einhalten.</translation></message>
<message><source>The medium behind the surface: a name such as "SCHOTT N-BK7", an index, or "nd 1.5168 vd 64.17".</source><translation>Was der Fläche folgt: ein Name wie "SCHOTT N-BK7", ein Index oder "nd 1.5168 vd 64.17".</translation></message>
<message><source>The next step (Alt+Right)</source><translation>Der nächste Schritt (Alt+Rechts)</translation></message>
<message><source>The object lies in the front focal plane, so its image is at infinity; move the source.</source><translation>Das Objekt liegt in der objektseitigen Brennebene, sein Bild also im Unendlichen; die Quelle verschieben.</translation></message>
<message><source>The panel's data are on the clipboard</source><translation>Die Daten der Ansicht sind in der Zwischenablage</translation></message>
<message><source>The panel's picture is on the clipboard</source><translation>Das Bild der Ansicht ist in der Zwischenablage</translation></message>
<message><source>The paper's lens: six elements round a stop, excellent on axis, oblique spherical at the corner</source><translation>Das Objektiv des Aufsatzes: sechs Linsen um eine Blende, hervorragend auf der Achse, schiefe sphärische Aberration in der Ecke</translation></message>
<message><source>The paraxial curve and its limits are of the aligned lens; the exact rays are not.</source><translation>Die paraxiale Kurve und ihre Grenzen gelten für das gerade gestellte Objektiv, die exakten Strahlen für das dejustierte.</translation></message>
<message><source>The piece that the sliders move: an element, a group, the whole lens or the sensor</source><translation>Das Teil, das die Regler bewegen: eine Linse, eine Gruppe, das ganze Objektiv oder der Sensor</translation></message>
<message><source>The point's spectrum; or type planck:4300 (kelvin) or lines:486,656 (nm)</source><translation>Das Spektrum des Punktes; oder planck:4300 (Kelvin) oder lines:486,656 (nm) tippen</translation></message>
<message><source>The proportions of the photo differ from those of the sensor ({columns} × {rows} pixels). It fills the frame; its sides are cut off, {percent:.0f} % of its width.</source><translation>Der Sensor hat {columns} × {rows} Pixel und das Foto ein anderes Seitenverhältnis, daher füllt es den Rahmen und ist seitlich abgeschnitten, {percent:.0f} % seiner Breite.</translation></message>
<message><source>The proportions of the photo differ from those of the sensor ({columns} × {rows} pixels). It fills the frame; its top and bottom are cut off, {percent:.0f} % of its height.</source><translation>Der Sensor hat {columns} × {rows} Pixel und das Foto ein anderes Seitenverhältnis, daher füllt es den Rahmen und ist oben und unten abgeschnitten, {percent:.0f} % seiner Höhe.</translation></message>
<message><source>The rear-stop landscape lens turned around: its stop stands before the meniscus</source><translation>Die Landschaftslinse mit hinterer Blende, umgedreht: ihre Blende steht vor dem Meniskus</translation></message>
<message><source>The selected element: drag it sideways to bend it, its thin-lens power stays; up or down to decentre it. A click selects its group.</source><translation>Die gewählte Linse: seitwärts ziehen, um sie durchzubiegen, ihre Brechkraft als dünne Linse bleibt; auf oder ab, um sie zu dezentrieren. Ein Klick wählt ihre Gruppe.</translation></message>
<message><source>The selected piece. A click selects its group; its sliders are in the Misalign panel.</source><translation>Das Gewählte. Ein Klick wählt seine Gruppe; seine Regler stehen im Feld Dejustieren.</translation></message>
<message><source>The selection: drag it along the axis, or up or down to decentre it. A click no longer selects glass.</source><translation>Das Gewählte: entlang der Achse ziehen, oder auf oder ab, um es zu dezentrieren. Ein Klick wählt kein Glas mehr.</translation></message>
<message><source>The sensitivities are computed from exact rays.</source><translation>Die Empfindlichkeiten werden aus exakten Strahlen berechnet.</translation></message>
<message><source>The sensor: drag it along the axis to shift it.</source><translation>Der Sensor: entlang der Achse ziehen, um ihn zu verschieben.</translation></message>
<message><source>The source: drag it up and down to change the field, sideways to change the depth; ∞ is at the left.</source><translation>Die Quelle: nach oben und unten ziehen ändert das Feld, seitlich den Abstand; ∞ liegt links.</translation></message>
<message><source>The step before (Alt+Left)</source><translation>Der Schritt davor (Alt+Links)</translation></message>
<message><source>The stop seen from the object: its diameter D = |f′|/N for a far object, its place from the first vertex.</source><translation>Die Blende vom Objekt aus gesehen: ihr Durchmesser D = |f′|/N für ein fernes Objekt, ihr Ort vom ersten Scheitel.</translation></message>
<message><source>The stop seen from the sensor: its diameter, and its place from the last vertex.</source><translation>Die Blende vom Sensor aus gesehen: ihr Durchmesser und ihr Ort vom letzten Scheitel.</translation></message>
<message><source>The stop's rim: drag it up or down to change the f-number.</source><translation>Der Rand der Blende: nach oben oder unten ziehen ändert die Blendenzahl.</translation></message>
<message><source>The stop: drag it along the axis within its air gap; the f-number stays.</source><translation>Die Blende: entlang der Achse in ihrem Luftabstand ziehen; die Blendenzahl bleibt.</translation></message>
<message><source>The surface whose rim limits the light: the smallest |rim/y| along the marginal ray, or the one that the file names.</source><translation>Die Fläche, deren Rand das Licht begrenzt: das kleinste |Rand/y| auf dem Weg des Randstrahls, oder wie es die Datei sagt.</translation></message>
<message><source>The surface's edge: drag it sideways to change the radius.</source><translation>Der Rand der Fläche: seitlich ziehen ändert den Radius.</translation></message>
<message><source>The telescope that the prescription meant, and that its later instruments see</source><translation>Das Teleskop, das der Entwurf meinte und das seine späteren Instrumente sehen</translation></message>
<message><source>The tolerances that workshops offer under this name; you can change the ± values below.</source><translation>Was Werkstätten unter diesem Namen anbieten; die ±-Werte unten lassen sich überschreiben.</translation></message>
<message><source>The vertex: drag it along the axis to change the thickness before it; what follows moves with it.</source><translation>Der Scheitel: entlang der Achse ziehen ändert die Dicke davor; was folgt, wandert mit.</translation></message>
<message><source>The wavefront as a surface; drag it or use the arrow keys to turn it</source><translation>Die Wellenfront als Fläche; durch Ziehen oder mit den Pfeiltasten zu drehen</translation></message>
<message><source>The whole plot</source><translation>Das ganze Diagramm</translation></message>
<message><source>The whole plot (Home, double-click)</source><translation>Das ganze Diagramm (Pos1, Doppelklick)</translation></message>
<message><source>The window</source><translation>Das Fenster</translation></message>
<message><source>The window began with this lesson, so there is nothing to restore; its lens stays</source><translation>Das Fenster begann mit dieser Lektion, also gibt es nichts zurückzuholen: ihr Objektiv bleibt</translation></message>
<message><source>The window could not be saved because its folder is not writable; save what you need with Ctrl+E.</source><translation>Das Fenster konnte nicht gespeichert werden, da sein Ordner nicht beschreibbar ist; was gebraucht wird, mit Strg+E speichern.</translation></message>
<message><source>Theme</source><translation>Aussehen</translation></message>
<message><source>Theory</source><translation>Theorie</translation></message>
<message><source>Theory of this panel</source><translation>Theorie zu dieser Ansicht</translation></message>
<message><source>Theory: conventions, formulas, sources</source><translation>Theorie: Konventionen, Formeln, Quellen</translation></message>
<message><source>These PSFs are ray densities; they are so wide that pixels hide most of what diffraction adds.</source><translation>Diese PSFs sind die Dichte der Strahlen; das meiste, was Beugung zu so breiten beiträgt, verbergen die Pixel.</translation></message>
<message><source>These settings cannot be computed; what was here belonged to the previous ones.</source><translation>Diese Einstellung lässt sich nicht berechnen; was hier war, gehört zur vorigen.</translation></message>
<message><source>Thickness {surface}</source><translation>Dicke {surface}</translation></message>
<message><source>Thickness, mm</source><translation>Dicke, mm</translation></message>
<message><source>Thickness: its error behind this surface; what follows moves with it.</source><translation>Dicke: ihr Fehler hinter dieser Fläche; was folgt, bewegt sich mit.</translation></message>
<message><source>This is A: a build is shown as A and the designed lens as B, and both have the same yield.</source><translation>Dies ist A: Ein Exemplar öffnet sich als A neben dem Objektiv wie entworfen, und beide haben eine Ausbeute.</translation></message>
<message><source>This is A: a database belongs to one lens.</source><translation>Dies ist A: eine Datenbank gehört zu einem Objektiv.</translation></message>
<message><source>This is A: a photograph cannot show negative light.</source><translation>Dies ist A: Licht, von dem A weniger hat als B, lässt sich nicht als Foto zeigen.</translation></message>
<message><source>This is A: a picture is measured beside one lens.</source><translation>Das ist A: Ein Bild wird neben einem Objektiv vermessen.</translation></message>
<message><source>This is A: a spot diagram has positions, not amounts, to subtract; the fans show A − B.</source><translation>Dies ist A: ein Spot besteht aus Orten von Strahlen, nicht aus Mengen; A − B zeigen die Fächer.</translation></message>
<message><source>This is A: each lens is measured against its own rays.</source><translation>Dies ist A: jedes Objektiv wird an seinen eigenen Strahlen gemessen.</translation></message>
<message><source>This is A: fields × A | B shows the pictures of both side by side.</source><translation>Das ist A: Felder × A | B zeigt die Bilder von beiden nebeneinander.</translation></message>
<message><source>This is A: here it is compared with a perfect lens.</source><translation>Dies ist A: hier wird es mit einem perfekten Objektiv verglichen.</translation></message>
<message><source>This is A: it has {a} surfaces and B has {b}, so they do not correspond.</source><translation>Dies ist A: es hat {a} Flächen und B hat {b}, sodass keine einer anderen entspricht.</translation></message>
<message><source>This is A: it is the lens that is edited here; the strip above names what differs.</source><translation>Dies ist A: bearbeitet wird hier dieses Objektiv; die Leiste oben nennt, worin sie sich unterscheiden.</translation></message>
<message><source>This is A: it is the lens whose build is set here; the strip above names what differs.</source><translation>Dies ist A: hier wird eingestellt, wie das Objektiv gebaut ist; der Streifen oben nennt, was verschieden ist.</translation></message>
<message><source>This is A: it is what was read from its file.</source><translation>Dies ist A: es ist, was aus seiner Datei gelesen wurde.</translation></message>
<message><source>This is A: one colour minus another is not a colour.</source><translation>Dies ist A: eine Farbe weniger eine andere ist keine Farbe.</translation></message>
<message><source>This is A: solid bodies have no difference to show.</source><translation>Dies ist A: Körper im Raum haben keine Differenz, die sich zeigen ließe.</translation></message>
<message><source>This is A: the curves of A or of B take longer than a frame.</source><translation>Das ist A: die Kurven von A oder von B brauchen länger als ein Bild.</translation></message>
<message><source>This is A: the limits of sharpness are positions, not amounts, to subtract.</source><translation>Dies ist A: die Grenzen der Schärfe sind Orte, keine Mengen, die sich abziehen ließen.</translation></message>
<message><source>This is A: the pictures of A and of B have different windows; PSF shows A − B.</source><translation>Dies ist A: über das Feld haben die Bilder von A und von B eigene Fenster; A − B zeigt die PSF.</translation></message>
<message><source>This is A: the points of the diagram are surfaces, and B has different ones.</source><translation>Dies ist A: die Punkte des Diagramms sind Flächen, und die von B sind andere.</translation></message>
<message><source>This is A: there are many curves already; MTF and Field show A − B.</source><translation>Dies ist A: es sind schon viele Kurven; MTF und Feld zeigen A − B.</translation></message>
<message><source>This is A: two drawings of lenses have no difference to draw.</source><translation>Dies ist A: zwei maßstäblich gezeichnete Objektive haben keine Differenz, die sich zeichnen ließe.</translation></message>
<message><source>This is A; B has none: {why}</source><translation>Dies ist A; B hat keines: {why}</translation></message>
<message><source>This lens has {count} such faults; p2sf info lists them all.</source><translation>Dieses Objektiv hat {count} solche Fehler; p2sf info zählt sie alle auf.</translation></message>
<message><source>This lesson has not been translated; here is the original</source><translation>Diese Lektion ist nicht übersetzt und steht hier, wie sie geschrieben wurde</translation></message>
<message><source>This panel has no numbers</source><translation>Diese Ansicht hat keine Zahlen</translation></message>
<message><source>This panel stands in its own window; close that window to have it back here.</source><translation>Diese Ansicht steht in einem eigenen Fenster; dieses schließen, um es hier wieder zu haben.</translation></message>
<message><source>Three elements, the fewest that correct all five Seidel sums</source><translation>Drei Linsen, die wenigsten, die alle fünf Seidel-Summen korrigieren</translation></message>
<message><source>Three plastic elements and six aspheres in 4.4 mm of length, as in the first phone cameras</source><translation>Drei Kunststofflinsen und sechs Asphären auf 4,4 mm Länge, wie in den ersten Telefonkameras</translation></message>
<message><source>Through focus</source><translation>Fokusreihe</translation></message>
<message><source>Through focus: the PSF at several sensor positions, brightness over that of the brightest. Drag the line or click: the sensor follows. S, T: where sagittal and tangential rays come to focus; best: smallest RMS wavefront.</source><translation>Fokusreihe: die PSF an mehreren Sensororten, Helligkeit über der hellsten. Die Linie ziehen oder klicken: der Sensor folgt. S, T: wo sagittale und tangentiale Strahlen zum Fokus kommen; best: kleinster RMS der Wellenfront.</translation></message>
<message><source>Tilt about x</source><translation>Kippung um x</translation></message>
<message><source>Tilt about x: right-handed; a positive one turns y towards z, the piece's top away from the object.</source><translation>Kippung um x: rechtshändig; eine positive dreht y nach z, das Teil oben vom Objekt weg.</translation></message>
<message><source>Tilt about y</source><translation>Kippung um y</translation></message>
<message><source>Tilt about y: right-handed; a positive one turns z towards x.</source><translation>Kippung um y: rechtshändig; eine positive dreht z nach x.</translation></message>
<message><source>Tilt by which the sensor recedes from the lens towards +x.</source><translation>Kippung, um die der Sensor nach +x vom Objektiv zurückweicht.</translation></message>
<message><source>Tilt by which the sensor recedes from the lens towards +y.</source><translation>Kippung, um die der Sensor nach +y vom Objektiv zurückweicht.</translation></message>
<message><source>To Image</source><translation>Ins Bild</translation></message>
<message><source>To pupil</source><translation>Als Pupille</translation></message>
<message><source>To report it, copy the text below and send it to the authors. It names versions and places in the program, but none of your folders or files.</source><translation>Um den Fehler zu melden, den Text unten kopieren und den Autoren schicken: Er nennt Versionen und Stellen im Programm, keinen Ordner und keine Datei von Ihnen.</translation></message>
<message><source>To the next part of the window</source><translation>Zum nächsten Teil des Fensters</translation></message>
<message><source>To the previous part of the window</source><translation>Zum vorigen Teil des Fensters</translation></message>
<message><source>Tolerance</source><translation>Toleranz</translation></message>
<message><source>Tolerance of all errors of this kind</source><translation>Toleranz aller Fehler dieser Art</translation></message>
<message><source>Tolerances</source><translation>Toleranzen</translation></message>
<message><source>Tolerances: every radius, thickness, glass, tilt, decentre and irregularity is off by what a workshop leaves, anywhere within its tolerance. Which error hurts most, and what share of 10 000 such lenses is good enough; each is focused again.</source><translation>Toleranzen: Jeder Radius, jede Dicke, jedes Glas, jede Verkippung, jede Dezentrierung und jeder Passfehler weicht ab, wie eine Werkstatt es zulässt, irgendwo innerhalb der Toleranz. Welcher Fehler am meisten schadet, und welcher Anteil von 10 000 solchen Objektiven gut genug ist; jedes wird neu fokussiert.</translation></message>
<message><source>Tolerated blur</source><translation>Erlaubte Unschärfe</translation></message>
<message><source>Tools</source><translation>Extras</translation></message>
<message><source>Track</source><translation>Baulänge</translation></message>
<message><source>Try</source><translation>Versuchen</translation></message>
<message><source>Tutorial</source><translation>Einführung</translation></message>
<message><source>Two achromats face to face, the stop in their common focus: for near objects only, image inverted</source><translation>Zwei Achromate einander zugewandt, die Blende in ihrem gemeinsamen Brennpunkt: nur für nahe Objekte, Bild umgekehrt</translation></message>
<message><source>Two cemented doublets, light from the eyepiece's side: the PSF is the spot it makes on the specimen</source><translation>Zwei verkittete Dubletts, Licht von der Okularseite: Die PSF ist der Fleck auf dem Präparat</translation></message>
<message><source>Two equal menisci about a stop: at unit magnification coma, distortion and lateral colour cancel exactly</source><translation>Zwei gleiche Menisken um eine Blende: beim Maßstab 1 heben sich Koma, Verzeichnung und Farbquerfehler genau auf</translation></message>
<message><source>Two groups, negative then positive: their space sets the focal length, and both move to keep focus</source><translation>Zwei Gruppen, negativ, dann positiv: Ihr Abstand setzt die Brennweite, und beide wandern, damit es scharf bleibt</translation></message>
<message><source>Two halves, each with the stop in its focus: the image keeps its size out of focus, and has no distortion</source><translation>Zwei Hälften, jede mit der Blende im Brennpunkt: Das Bild behält unscharf seine Größe und ist verzeichnungsfrei</translation></message>
<message><source>Type a few letters, choose with ↑ ↓, run with Enter, leave with Escape.</source><translation>Einige Buchstaben tippen, mit ↑ ↓ wählen, Enter führt aus, Esc geht zurück.</translation></message>
<message><source>Type that suits the screen</source><translation>Schriftgröße, die zum Bildschirm passt</translation></message>
<message><source>Typed numbers may have a decimal point or a decimal comma; files and the command line take a decimal point.</source><translation>Getippte Zahlen dürfen Dezimalpunkt oder Dezimalkomma haben; Dateien und die Kommandozeile nehmen den Dezimalpunkt.</translation></message>
<message><source>Undo</source><translation>Rückgängig</translation></message>
<message><source>Undo: take back one step (Ctrl+Z)</source><translation>Rückgängig: einen Schritt zurücknehmen (Strg+Z)</translation></message>
<message><source>Unexpected error</source><translation>Unerwarteter Fehler</translation></message>
<message><source>Units of the colour bar</source><translation>Einheit der Farbskala</translation></message>
<message><source>Unpin</source><translation>B lösen</translation></message>
<message><source>Values separated by semicolons; empty: evenly spread automatically</source><translation>Werte mit Strichpunkten dazwischen; leer: von selbst gleichmäßig verteilt</translation></message>
<message><source>Vane angle</source><translation>Strebenwinkel</translation></message>
<message><source>Vane angle: direction of the first vane, from the direction of the field (+η) towards +ξ.</source><translation>Strebenwinkel: Richtung der ersten Strebe, von der Richtung des Feldes (+η) nach +ξ.</translation></message>
<message><source>Vane width</source><translation>Strebenbreite</translation></message>
<message><source>Vane width, as a share of the rim's diameter.</source><translation>Breite der Streben, bezogen auf den Durchmesser des Randes.</translation></message>
<message><source>Vanes</source><translation>Streben</translation></message>
<message><source>Vanes of the spider that holds the obscuration, from the middle to the rim, evenly spaced; 0: none. Each makes a spike at right angles to itself.</source><translation>Streben der Spinne, die das Abschattende hält, von der Mitte zum Rand und gleichmäßig ringsum; 0: keine. Jede wirft einen Strahl quer zu sich.</translation></message>
<message><source>View</source><translation>Darstellung</translation></message>
<message><source>Viridis</source><translation>Viridis</translation></message>
<message><source>W modulo 1, waves</source><translation>W modulo 1, Wellen</translation></message>
<message><source>W × {front} along the rays · PSF × {psf} wide, height: {scale} · {wavelength} nm</source><translation>W × {front} längs der Strahlen · PSF × {psf} breit, Höhe: {scale} · {wavelength} nm</translation></message>
<message><source>W, waves</source><translation>W, Wellen</translation></message>
<message><source>W11 added</source><translation>W11 hinzu</translation></message>
<message><source>W11 distortion</source><translation>W11 Verzeichnung</translation></message>
<message><source>W20 added</source><translation>W20 hinzu</translation></message>
<message><source>W20 field curvature</source><translation>W20 Bildfeldwölbung</translation></message>
<message><source>W20 of the frame</source><translation>W20 der Aufnahme</translation></message>
<message><source>W22 added</source><translation>W22 hinzu</translation></message>
<message><source>W22 astigmatism</source><translation>W22 Astigmatismus</translation></message>
<message><source>W22 of the frame</source><translation>W22 der Aufnahme</translation></message>
<message><source>W31 added</source><translation>W31 hinzu</translation></message>
<message><source>W31 coma</source><translation>W31 Koma</translation></message>
<message><source>W31 of the frame</source><translation>W31 der Aufnahme</translation></message>
<message><source>W40 added</source><translation>W40 hinzu</translation></message>
<message><source>W40 of the frame</source><translation>W40 der Aufnahme</translation></message>
<message><source>W40 spherical aberration</source><translation>W40 sphärische Aberration</translation></message>
<message><source>Wavefront W over the pupil: by how many waves the optical path of a ray is shorter than that of the chief ray. What the stop hides is left out, and a filter shades the picture.</source><translation>Wellenfront W über der Pupille: um wie viele Wellen der optische Weg eines Strahls kürzer ist als der des Hauptstrahls. Was in der Blende steht, ist ausgespart, und der Schatten eines Filters liegt über dem Bild.</translation></message>
<message><source>Wavefront coefficients: the peak value of each term of W(ρ, θ) at this field, in waves.</source><translation>Wellenfrontkoeffizienten: der Höchstwert jedes Glieds von W(ρ, θ) an diesem Feld, in Wellen.</translation></message>
<message><source>Wavelength</source><translation>Wellenlänge</translation></message>
<message><source>Wavelength λ in vacuum; the index of each glass n(λ) follows it. F, d and C are Fraunhofer's lines.</source><translation>Wellenlänge λ im Vakuum; der Brechungsindex n(λ) jedes Glases folgt ihr. F, d und C sind Fraunhofers Linien.</translation></message>
<message><source>Wavelengths</source><translation>Wellenlängen</translation></message>
<message><source>Wavelengths in nm: 486.1; 587.6; 656.3. A range: 400:700:7</source><translation>Wellenlängen in nm: 486,1; 587,6; 656,3. Eine Reihe: 400:700:7</translation></message>
<message><source>Wd</source><translation>Wd</translation></message>
<message><source>Wd = 0: a line towards the field</source><translation>Wd = 0: eine Linie zum Feld hin</translation></message>
<message><source>Wd = −2 W40: rim rays meet on the axis</source><translation>Wd = −2 W40: Randstrahlen treffen sich auf der Achse</translation></message>
<message><source>Wd = −W22/2: a cross</source><translation>Wd = −W22/2: ein Kreuz</translation></message>
<message><source>Wd = −W22: a line across the field</source><translation>Wd = −W22: eine Linie quer zum Feld</translation></message>
<message><source>Wd = −W40 leaves a sixteenth of the variance</source><translation>Wd = −W40 lässt ein Sechzehntel der Varianz</translation></message>
<message><source>Wd added</source><translation>Wd hinzu</translation></message>
<message><source>Wd defocus</source><translation>Wd Defokus</translation></message>
<message><source>Wd is muted</source><translation>Wd ist stumm</translation></message>
<message><source>What changes from column to column</source><translation>Was sich von Spalte zu Spalte ändert</translation></message>
<message><source>What do you want to do?</source><translation>Was soll geschehen?</translation></message>
<message><source>What is adjusted in every lens at assembly so that the mean square of the wavefronts of all fields is smallest.</source><translation>Was bei der Montage jedes Objektivs eingestellt wird, sodass das mittlere Quadrat der Wellenfronten aller Felder am kleinsten ist.</translation></message>
<message><source>What whole numbers of the picture mean; automatic takes 8 bits for sRGB</source><translation>Was ganze Zahlen des Bildes bedeuten; automatisch gelten 8 Bit als sRGB</translation></message>
<message><source>a picture of shape {shape}; give rows, columns and colours</source><translation>ein Bild der Form {shape}; Zeilen, Spalten und Farben angeben</translation></message>
<message><source>absorption is on, but the internal transmittance of {glasses} is unknown, so they count as clear; import the lens with their catalogues in the AGF format</source><translation>die Absorption ist an, aber von {glasses} ist kein Reintransmissionsgrad bekannt, sie absorbieren hier nichts; das Objektiv mit ihren Katalogen im AGF-Format einlesen</translation></message>
<message><source>automatic</source><translation>automatisch</translation></message>
<message><source>measuring, {percent} %, {left} s left</source><translation>misst, {percent} %, noch {left} s</translation></message>
<message><source>no numbers: what the model leaves is {chi2:.3g} times the variance of the noise, and {most:g} is the most. Try more numbers; check f-number, wavelength, pixel and stated noise, state the gain of bright points, and see that the picture is linear and sharp, and the points much smaller than a pixel</source><translation>keine Zahlen: das Modell lässt das {chi2:.3g}-Fache der Varianz des Rauschens übrig, höchstens das {most:g}-Fache darf es sein. Versuchen Sie mehr Zahlen; prüfen Sie Blendenzahl, Wellenlänge, Pixel und das angegebene Rauschen, geben Sie bei hellen Punkten die Verstärkung an, und sehen Sie nach, ob das Bild linear und unverwackelt ist und die Punkte viel kleiner als ein Pixel sind</translation></message>
<message><source>a picture {width:.3g} µm wide is {times:.2g} times as wide as the PSF of a perfect lens, λ/(2 NA) of {perfect:.2g} µm, and its fit needs {nodes} pupil samples; check that {wavelength} is in nm and {pixel} in µm, or crop the picture</source><translation>ein {width:.3g} µm breites Bild ist {times:.2g}-mal so breit wie die PSF eines vollkommenen Objektivs, λ/(2 NA) von {perfect:.2g} µm, und seine Anpassung braucht {nodes} Stützstellen in der Pupille; prüfen, ob {wavelength} in nm und {pixel} in µm angegeben ist, oder das Bild beschneiden</translation></message>
<message><source>{count} pixels have the highest count, {top:g}, side by side: they were clipped, and do not count; expose less, or state the full scale</source><translation>{count} Pixel haben nebeneinander den höchsten Zählwert, {top:g}: sie sind übersteuert und zählen nicht; kürzer belichten oder den Endwert angeben</translation></message>
<message><source>noise is {share:.0%} of what the picture shows, and a wavefront farther from the true one than these errors may hide in it; expose longer, average pictures, or add a focus</source><translation>Rauschen macht {share:.0%} dessen aus, was das Bild zeigt, und eine Wellenfront, die von der wahren weiter abweicht als diese Fehler, kann sich darin verbergen; länger belichten, Bilder mitteln oder einen zweiten Fokus aufnehmen</translation></message>
<message><source>{parameter} is {value:g} nm; if these are µm, give nanometres, {nm:g}</source><translation>{parameter} ist {value:g} nm; wenn das µm sind, geben Sie Nanometer an, {nm:g}</translation></message>
<message><source>{parameter} is {value}; give a p2sf.Source, or name what it is, such as depth_mm=3000</source><translation>{parameter} ist {value}; geben Sie ein p2sf.Source an oder benennen Sie es, etwa depth_mm=3000</translation></message>
<message><source>{parameter} is {value}; give the least or the most of figures by name, such as {example}; tolerances are those of a grade</source><translation>{parameter} ist {value}; Mindest- oder Höchstwerte mit Namen angeben, etwa {example}; die Toleranzen sind die einer Güteklasse</translation></message>
<message><source>{parameter} reaches to {far:g} mm, for a lens in focus at {sharp:.4g} mm with its front focus {focus:.4g} mm before it; give millimetres, 1000 for each metre</source><translation>{parameter} reicht bis {far:g} mm, bei einem Objektiv, das auf {sharp:.4g} mm scharf gestellt ist und dessen vorderer Brennpunkt {focus:.4g} mm vor ihm liegt; in Millimetern angeben, 1000 für jeden Meter</translation></message>
<message><source>no point is in this picture; give one whose middle holds its light</source><translation>in diesem Bild ist kein Punkt; eines angeben, in dessen Mitte sein Licht liegt</translation></message>
<message><source>numbers read as linear counts</source><translation>Zahlen als lineare Zählwerte gelesen</translation></message>
<message><source>numbers read as sRGB and made linear</source><translation>Zahlen als sRGB gelesen und linear gemacht</translation></message>
<message><source>sRGB</source><translation>sRGB</translation></message>
<message><source>XY polynomial</source><translation>XY-Polynom</translation></message>
<message><source>Zernike fringe sag</source><translation>Zernike-Fläche (Fringe)</translation></message>
<message><source>Zernike standard sag</source><translation>Zernike-Fläche (Standard)</translation></message>
<message><source>an ISET file</source><translation>eine ISET-Datei</translation></message>
<message><source>axes decentred by ({decentre:g}) mm and tilted by ({tilt:g})°</source><translation>Achsen um ({decentre:g}) mm dezentriert und um ({tilt:g})° gekippt</translation></message>
<message><source>has a term in {term}</source><translation>hat ein Glied in {term}</translation></message>
<message><source>irregular</source><translation>Passfehler</translation></message>
<message><source>irregular: {fringes:g} fringes, at 45° {turned:g}, over a radius of {radius:g} mm</source><translation>Passfehler: {fringes:g} Ringe, unter 45° {turned:g}, über einem Radius von {radius:g} mm</translation></message>
<message><source>has a shape that is not of revolution ({kind})</source><translation>ist keine Rotationsfläche ({kind})</translation></message>
<message><source>its aspheric terms</source><translation>ihre asphärischen Glieder</translation></message>
<message><source>its clear rim</source><translation>ihr freier Rand</translation></message>
<message><source>its conic constant</source><translation>ihre konische Konstante</translation></message>
<message><source>its hole or obscuration</source><translation>ihr Loch oder ihre Abschattung</translation></message>
<message><source>its ideal focal length</source><translation>ihre ideale Brennweite</translation></message>
<message><source>its irregularity</source><translation>ihr Passfehler</translation></message>
<message><source>its radius</source><translation>ihr Radius</translation></message>
<message><source>rays within a radius of {radius:g} mm are lost</source><translation>Strahlen innerhalb eines Radius von {radius:g} mm gehen verloren</translation></message>
<message><source>rectangular rim about ({centre:g}) mm, half-widths {widths:g} mm, turned by {turn:g}°</source><translation>rechteckiger Rand um ({centre:g}) mm, halbe Breiten {widths:g} mm, um {turn:g}° gedreht</translation></message>
<message><source>rim about ({centre:g}) mm</source><translation>Rand um ({centre:g}) mm</translation></message>
<message><source>surface {surface} differs between columns in its shape, its rim or a medium without a name, for which a Zemax file has no line; save as TOML</source><translation>Fläche {surface} unterscheidet sich zwischen Spalten in Form, Rand oder einem Medium ohne Namen, wofür eine Zemax-Datei keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} has even terms beside its shape ({kind}), or that of a higher degree than a CODE V file holds; save as TOML</source><translation>Fläche {surface} ({kind}) hat gerade Glieder daneben oder einen höheren Grad, als eine CODE-V-Datei fasst; als TOML speichern</translation></message>
<message><source>surface {surface} has even terms or diffraction beside its shape ({kind}), for which Zemax has no line; save as TOML</source><translation>Fläche {surface} ({kind}) hat gerade Glieder oder Beugung daneben, wofür Zemax keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} is tilted, decentred or not of revolution, and {what} supports only rotational symmetry; {remedy}</source><translation>Fläche {surface} ist gekippt, dezentriert oder keine Rotationsfläche, und {what} kennt nur Rotationssymmetrie; {remedy}</translation></message>
<message><source>surface {surface} {reason}</source><translation>Fläche {surface} {reason}</translation></message>
<message><source>surface {surface} {reason}, for which there are no Seidel sums and no six coefficients; choose the method fitted, traced or huygens</source><translation>Fläche {surface} {reason}, wofür es keine Seidelsummen und keine sechs Koeffizienten gibt; das Verfahren fitted, traced oder huygens wählen</translation></message>
<message><source>surface {surface}: a file that ends in {ending} cannot express {what}; save as TOML</source><translation>Fläche {surface}: {what} lässt sich in einer Datei mit der Endung {ending} nicht ausdrücken; als TOML speichern</translation></message>
<message><source>surface {surface}: transmission {vertex:g} with {slope:g} per mm²; give a share from 0 to 1 and a finite number</source><translation>Fläche {surface}: Durchlässigkeit {vertex:g} mit {slope:g} je mm²; einen Anteil von 0 bis 1 und eine endliche Zahl angeben</translation></message>
<message><source>the lesson has no step; add what is on screen</source><translation>die Lektion hat keinen Schritt; anfügen, was zu sehen ist</translation></message>
<message><source>the lesson has no title; give it one</source><translation>die Lektion hat keinen Titel; einen angeben</translation></message>
<message><source>the medium behind surface {surface} absorbs light along paths of different lengths</source><translation>das Medium hinter Fläche {surface} absorbiert Licht auf verschieden langen Wegen</translation></message>
<message><source>the centre of the obscuration lies behind a blade of the iris; move it or open the iris</source><translation>die Mitte der Abschattung liegt hinter einer Lamelle der Iris; sie verschieben oder die Iris öffnen</translation></message>
<message><source>the surface is not of revolution, so even terms cannot describe it; keep its shape</source><translation>die Fläche ist keine Rotationsfläche, die keine geraden Glieder beschreiben; ihre Form behalten</translation></message>
<message><source>the thickness behind it</source><translation>die Dicke dahinter</translation></message>
<message><source>this camera has no lens; give its name, a file or what p2sf.load_lens returns as the first argument</source><translation>diese Kamera hat kein Objektiv; seinen Namen, eine Datei oder was p2sf.load_lens zurückgibt als erstes Argument angeben</translation></message>
<message><source>this camera has no pixels; give {parameter}</source><translation>diese Kamera hat keine Pixel; {parameter} angeben</translation></message>
<message><source>this database has fields along one line; give angles from the axis, without {parameter}</source><translation>diese Datenbank hat Felder entlang einer Linie; Winkel von der Achse angeben, ohne {parameter}</translation></message>
<message><source>transmission {vertex:g} + {slope:g} mm⁻²·h²</source><translation>Durchlässigkeit {vertex:g} + {slope:g} mm⁻²·h²</translation></message>
<message><source>what is left is {chi2:.2g} times the variance of the noise, so the noise is less than taken and the errors are too large; check the read noise and the gain, and that the picture was not smoothed</source><translation>übrig bleibt das {chi2:.2g}-Fache der Varianz des Rauschens, also ist das Rauschen kleiner als angenommen, und die Fehler sind zu groß; Ausleserauschen und Verstärkung prüfen, und ob das Bild geglättet wurde</translation></message>
<message><source>What moves A and B together</source><translation>Was A und B gemeinsam bewegt</translation></message>
<message><source>What stands in front of the lens</source><translation>Was vor dem Objektiv steht</translation></message>
<message><source>What stands in the stop: an obscuration, the blades of an iris, the vanes of a spider, a filter, a phase plate; phases and amplitudes of a lens file stay.</source><translation>Was in der Blende steht: eine Abschattung, die Lamellen einer Iris, die Streben einer Spinne, ein Filter, eine Phasenplatte; Phasen und Amplituden einer Objektivdatei bleiben.</translation></message>
<message><source>What the film shows</source><translation>Was der Film zeigt</translation></message>
<message><source>What the pictures show</source><translation>Was die Bilder zeigen</translation></message>
<message><source>What the slider sets: an error, or the time of a picture</source><translation>Worum es beim Regler geht: einen Fehler oder die Zeit eines Bildes</translation></message>
<message><source>What-if: waves added to the six coefficients</source><translation>Was wäre wenn: Wellen, zu den sechs Koeffizienten hinzugefügt</translation></message>
<message><source>When the sliders rest, the picture is compared with a converged sum of exact rays (Huygens): the reference, the difference, and what every method costs in time and error appear here.</source><translation>Wenn die Regler ruhen, wird das Bild mit einer auskonvergierten Summe exakter Strahlen (Huygens) verglichen: Referenz, Unterschied und was jede Methode an Zeit und Fehler kostet, erscheinen hier.</translation></message>
<message><source>Where it is on the sensor: x and y from the chief ray.</source><translation>Wo sie auf dem Sensor liegt: x und y vom Hauptstrahl aus.</translation></message>
<message><source>Whether the plot at the right shows every method at this point, or every representation of all PSFs of the lens</source><translation>Was das rechte Diagramm zeigt: alle Verfahren an diesem Punkt, oder alle Darstellungen aller PSFs des Objektivs</translation></message>
<message><source>Which coefficient</source><translation>Welcher Koeffizient</translation></message>
<message><source>Which curves are shown</source><translation>Welche Kurven gezeigt werden</translation></message>
<message><source>Which order of the terms</source><translation>Welche Reihenfolge der Terme</translation></message>
<message><source>Which picture is made</source><translation>Welches Bild gemacht wird</translation></message>
<message><source>Which slider moves</source><translation>Welcher Regler sich bewegt</translation></message>
<message><source>Which sum</source><translation>Welche Summe</translation></message>
<message><source>Why the picture is computed this way: the decisions of the plan, each with its error</source><translation>Warum das Bild so berechnet wird: die Entscheidungen des Plans, jede mit ihrem Fehler</translation></message>
<message><source>Why…</source><translation>Warum …</translation></message>
<message><source>Wiener's filter by the PSFs of this lens, for noise between {least:.2%} and {most:.2%} of white: what the photo tells.</source><translation>Wiener-Filter mit den PSFs dieses Objektivs, für ein Rauschen zwischen {least:.2%} und {most:.2%} von Weiß: was das Foto verrät.</translation></message>
<message><source>Window</source><translation>Fenster</translation></message>
<message><source>Working f-number</source><translation>Wirksame Blendenzahl</translation></message>
<message><source>Working f-number 1/(2 NA) at this depth.</source><translation>Wirksame Blendenzahl 1/(2 NA) bei diesem Abstand.</translation></message>
<message><source>Workspace</source><translation>Arbeitsbereich</translation></message>
<message><source>Workspaces: save this one, delete it, or choose another</source><translation>Arbeitsbereiche: diesen speichern oder löschen, oder einen anderen wählen</translation></message>
<message><source>Worst builds: click to see one as A beside the lens as designed, B</source><translation>Schlechteste Exemplare: ein Klick zeigt eines als A neben dem Objektiv wie entworfen, B</translation></message>
<message><source>Write a lens file</source><translation>Eine Objektivdatei schreiben</translation></message>
<message><source>You can go on. If something looks wrong, undo the last step (Ctrl+Z), or close the explorer and start it again.</source><translation>Es kann weitergehen. Sieht etwas falsch aus, den letzten Schritt zurücknehmen (Strg+Z) oder den Explorer schließen und neu starten.</translation></message>
<message><source>ZOO {name} has {values} values for {count} zoom positions; write one for each</source><translation>ZOO {name} hat {values} Werte für {count} Zoomstellungen; für jede einen schreiben</translation></message>
<message><source>Zernike</source><translation>Zernike</translation></message>
<message><source>Zernike grid</source><translation>Zernike-Gitter</translation></message>
<message><source>Zernike terms of the wavefront that makes the picture, orthogonal over the part of the pupil that passes light; θ from +x. Percent: share of the variance without piston and tilt, which do not blur.</source><translation>Zernike-Terme der Wellenfront, die das Bild macht, orthogonal über den Teil der Pupille, der Licht durchlässt; θ ab +x. Prozent: Anteil an der Varianz ohne Kolbenterm und Verkippung, die nicht unscharf machen.</translation></message>
<message><source>Zoom</source><translation>Zoom</translation></message>
<message><source>Zoom in</source><translation>Vergrößern</translation></message>
<message><source>Zoom lens 3×, 20 to 60 mm</source><translation>Zoomobjektiv 3×, 20 bis 60 mm</translation></message>
<message><source>Zoom out</source><translation>Verkleinern</translation></message>
<message><source>Zoom: position of the ring, on the lens's own scale. ▾ marks the columns of the lens file, between which the lens is interpolated.</source><translation>Zoom: wo der Ring des Objektivs steht, auf seiner eigenen Skala. ▾ sind die Spalten der Objektivdatei, zwischen denen das Objektiv interpoliert wird.</translation></message>
<message><source>Z{number}: {waves} λ · {share}</source><translation>Z{number}: {waves} λ · {share}</translation></message>
<message><source>[aperture] states {count} of {names}; keep exactly one</source><translation>[aperture] gibt {count} von {names} an; genau eines behalten</translation></message>
<message><source>[sensor] lacks {missing}; add it</source><translation>in [sensor] fehlt {missing}; hinzufügen</translation></message>
<message><source>a Fresnel surface</source><translation>eine Fresnel-Fläche</translation></message>
<message><source>a Zemax file with configurations</source><translation>eine Zemax-Datei mit Konfigurationen</translation></message>
<message><source>a bend (BEN) about more than one axis is not read; write the tilt behind it by itself</source><translation>eine Knickung (BEN) um mehr als eine Achse wird nicht gelesen; die Kippung dahinter für sich schreiben</translation></message>
<message><source>a black box that hides its surfaces</source><translation>eine Black Box, die ihre Flächen verbirgt</translation></message>
<message><source>a blur of {size} pixels with {samples} samples each needs a {side}² transform; bring the depths nearer to focus, stop down, or ask for larger pixels</source><translation>eine Unschärfe von {size} Pixeln mit je {samples} Proben braucht eine Transformation von {side}²; die Abstände dem Fokus nähern, abblenden oder größere Pixel verlangen</translation></message>
<message><source>a blur of {waves:.0f} waves per pupil radius behind a mask; bring the sensor nearer to the image or stop down</source><translation>eine Unschärfe von {waves:.0f} Wellen je Pupillenradius hinter einer Maske; den Sensor näher an das Bild bringen oder abblenden</translation></message>
<message><source>a blur of {waves:.0f} waves per pupil radius needs {lines} × {samples} pupil samples; bring the sensor nearer to the image or stop down</source><translation>eine Unschärfe von {waves:.0f} Wellen je Pupillenradius braucht {lines} × {samples} Pupillenproben; den Sensor dem Bild nähern oder abblenden</translation></message>
<message><source>a chart of {columns} × {rows} pixels; give {least} to {most} each way</source><translation>eine Tafel von {columns} × {rows} Pixeln; {least} bis {most} je Richtung angeben</translation></message>
<message><source>a circle</source><translation>ein Kreis</translation></message>
<message><source>a dark centre: Wd of a whole wave cancels on the axis</source><translation>eine dunkle Mitte: Wd von einer ganzen Welle löscht auf der Achse aus</translation></message>
<message><source>a database of fields along one line</source><translation>eine Datenbank mit Feldern auf einer Linie</translation></message>
<message><source>a database of the six coefficients</source><translation>eine Datenbank der sechs Koeffizienten</translation></message>
<message><source>a diffractive surface</source><translation>eine diffraktive Fläche</translation></message>
<message><source>a frame of shape {shape}; give rows and columns of counts</source><translation>eine Aufnahme der Form {shape}; Zeilen und Spalten von Zählwerten angeben</translation></message>
<message><source>a frame without a finite count; check the file and its dark and flat fields</source><translation>eine Aufnahme ohne einen endlichen Zählwert; die Datei und ihr Dunkel- und Hellbild prüfen</translation></message>
<message><source>a glass needs a name and a formula number (NM name formula …); complete it</source><translation>ein Glas braucht Namen und Formelnummer (NM Name Formel …); ergänzen</translation></message>
<message><source>a gradient index</source><translation>ein Gradientenindex</translation></message>
<message><source>a lens file of this program, exactly as written</source><translation>eine Objektivdatei dieses Programms, genau wie geschrieben</translation></message>
<message><source>a lens lists its "surfaces"</source><translation>ein Objektiv listet seine "surfaces"</translation></message>
<message><source>a lens needs at least one surface; insert another before deleting this one</source><translation>ein Objektiv braucht mindestens eine Fläche; eine andere einfügen, bevor diese gelöscht wird</translation></message>
<message><source>a lesson begins with a line "{fence}"; put title, about and lens below it</source><translation>eine Lektion beginnt mit einer Zeile "{fence}"; title, about und lens darunter schreiben</translation></message>
<message><source>a map of the pupil has cells that are not finite; give every cell a finite number</source><translation>eine Karte der Pupille hat Zellen, die keine endlichen Zahlen sind; jeder Zelle eine geben</translation></message>
<message><source>a map of the pupil has the shape {shape}; give a square of {low} to {high} cells a side</source><translation>eine Karte der Pupille hat die Form {shape}; ein Quadrat von {low} bis {high} Zellen je Seite angeben</translation></message>
<message><source>the phase in the stop bends light by diffraction, which rays alone do not show; remove the phase</source><translation>die Phase in der Blende lenkt Licht durch Beugung ab, was Strahlen allein nicht zeigen; die Phase wegnehmen</translation></message>
<message><source>a mask stands in the stop, which a file that ends in {ending} cannot express; save as TOML</source><translation>in der Blende steht eine Maske, was eine Datei mit der Endung {ending} nicht ausdrücken kann; als TOML speichern</translation></message>
<message><source>a mirror has no refractive index; ask for that of the medium in front of it</source><translation>ein Spiegel hat keine Brechzahl; nach der des Mediums davor fragen</translation></message>
<message><source>a non-sequential part</source><translation>ein nicht sequentieller Teil</translation></message>
<message><source>a number is too large or too small for a lens; correct it</source><translation>eine Zahl ist zu groß oder zu klein für ein Objektiv; berichtigen</translation></message>
<message><source>this blur over a window {width:.3g} µm wide needs {radii} × {directions} pupil samples; bring the sensor nearer to the image, stop down, or show a smaller window</source><translation>diese Unschärfe über ein Fenster von {width:.3g} µm braucht {radii} × {directions} Pupillenproben; den Sensor dem Bild nähern, abblenden oder ein kleineres Fenster zeigen</translation></message>
<message><source>a phase slope of {slope:.0f} waves over a window of {cycles:.0f} cycles needs {rows} × {columns} pupil samples; bring the sensor nearer to the image, stop down, or show a smaller window</source><translation>eine Phasensteigung von {slope:.0f} Wellen über ein Fenster von {cycles:.0f} Perioden braucht {rows} × {columns} Pupillenproben; den Sensor dem Bild nähern, abblenden oder ein kleineres Fenster zeigen</translation></message>
<message><source>a picture in ≤ {ms} ms</source><translation>ein Bild in ≤ {ms} ms</translation></message>
<message><source>a picture of {shape} pixels; give at least {least} × {least}</source><translation>ein Bild von {shape} Pixeln; mindestens {least} × {least} angeben</translation></message>
<message><source>a point at ({x:.4g}, {y:.4g}) mm lies off the sensor; take a larger one</source><translation>ein Punkt bei ({x:.4g}, {y:.4g}) mm liegt neben dem Sensor; einen größeren nehmen</translation></message>
<message><source>a profile through "{place}" is unknown; choose "chief" or "peak"</source><translation>ein Profil durch "{place}" ist unbekannt; "chief" oder "peak" wählen</translation></message>
<message><source>a pupil grid of {size} samples; give an even count of at least 2</source><translation>ein Pupillengitter aus {size} Proben; eine gerade Anzahl ab 2 angeben</translation></message>
<message><source>a question and its answer go together; give both ask: and tell:</source><translation>eine Frage und ihre Antwort gehören zusammen; ask: und tell: angeben</translation></message>
<message><source>a radius of 0 with an index is a plane</source><translation>ein Radius 0 mit einem Index ist eine Ebene</translation></message>
<message><source>a rectangle</source><translation>ein Rechteck</translation></message>
<message><source>a row has {count} columns; write radius, thickness, index, diameter</source><translation>eine Zeile hat {count} Spalten; Radius, Dicke, Index, Durchmesser schreiben</translation></message>
<message><source>a row of aspherical data needs number, radius, conic; complete it</source><translation>eine Zeile asphärischer Daten braucht Nummer, Radius, Kegelschnitt; ergänzen</translation></message>
<message><source>a row of lens data needs number, radius and distance; complete it</source><translation>eine Zeile der Linsendaten braucht Nummer, Radius und Abstand; ergänzen</translation></message>
<message><source>a set of PSFs needs a depth, a field and a wavelength at least; give one of each</source><translation>ein Satz PSFs braucht mindestens einen Abstand, ein Feld und eine Wellenlänge; je eines angeben</translation></message>
<message><source>a sharp core in a wide halo</source><translation>ein scharfer Kern in weitem Hof</translation></message>
<message><source>a surface that is not round</source><translation>eine Fläche, die nicht rund ist</translation></message>
<message><source>a text</source><translation>einen Text</translation></message>
<message><source>a wavefront of {shape} with areas of {areas}; give two equal even squares</source><translation>eine Wellenfront {shape} mit Flächen {areas}; zwei gleiche Quadrate gerader Seitenzahl angeben</translation></message>
<message><source>a wavefront on {size} cells repeats its PSF every {period:.4g} µm, and the window is {window:.4g} µm wide; give a finer grid or a smaller window</source><translation>eine Wellenfront auf {size} Zellen wiederholt ihre PSF alle {period:.4g} µm, und das Fenster ist {window:.4g} µm breit; ein feineres Gitter oder ein kleineres Fenster angeben</translation></message>
<message><source>a wavelength is not that of light; give micrometres</source><translation>eine Wellenlänge ist nicht die von Licht; Mikrometer angeben</translation></message>
<message><source>a wavelength is not that of light; give nanometres</source><translation>eine Wellenlänge ist nicht die von Licht; Nanometer angeben</translation></message>
<message><source>a wavelength of {nm:g} nm that brings {share:g} of the light; give two positive numbers</source><translation>eine Wellenlänge von {nm:g} nm, die {share:g} des Lichts bringt; zwei positive Zahlen angeben</translation></message>
<message><source>a whole number</source><translation>eine ganze Zahl</translation></message>
<message><source>a {axis} node is not finite; only a depth may be infinite</source><translation>bei {axis} ist ein Knoten nicht endlich; nur ein Objektabstand darf unendlich sein</translation></message>
<message><source>a scene with {parameter} has halos fainter than the error of a low rank; choose {method} patches</source><translation>eine Szene mit {parameter} hat Lichthöfe, die schwächer sind als der Fehler eines niedrigen Rangs; {method} patches wählen</translation></message>
<message><source>a {ending} of depth {depth} cannot be written; choose {choices}</source><translation>ein {ending} der Tiefe {depth} lässt sich nicht schreiben; {choices} wählen</translation></message>
<message><source>adds, λ</source><translation>Beitrag, λ</translation></message>
<message><source>agf_formula is {formula}; write a number from 1 to 13</source><translation>agf_formula ist {formula}; eine Zahl von 1 bis 13 schreiben</translation></message>
<message><source>aim "{aim}" is unknown; choose "stop" or "paraxial"</source><translation>die Ausrichtung "{aim}" ist unbekannt; "stop" oder "paraxial" wählen</translation></message>
<message><source>aimed at the real stop</source><translation>auf die wahre Blende gerichtet</translation></message>
<message><source>air</source><translation>Luft</translation></message>
<message><source>align it</source><translation>sie gerade stellen</translation></message>
<message><source>all</source><translation>alle</translation></message>
<message><source>all PSFs, by bytes</source><translation>alle PSFs, nach Bytes</translation></message>
<message><source>all PSFs, by time</source><translation>alle PSFs, nach Zeit</translation></message>
<message><source>all panels</source><translation>alle Ansichten</translation></message>
<message><source>all sums</source><translation>alle Summen</translation></message>
<message><source>along x</source><translation>längs x</translation></message>
<message><source>along y</source><translation>längs y</translation></message>
<message><source>an FFT needs an even number of PSF samples, not {pixels}; add one or use mdft</source><translation>eine FFT braucht eine gerade Anzahl von PSF-Proben, nicht {pixels}; eine hinzufügen oder mdft nehmen</translation></message>
<message><source>an FFT of square samples does not resolve the edges of a mask; use mdft</source><translation>eine FFT quadratischer Abtastwerte zeigt keine Kanten einer Maske; mdft verwenden</translation></message>
<message><source>an FFT of square samples shows no edges of rims; use mdft, or leave {parameter} off</source><translation>eine FFT aus quadratischen Abtastwerten zeigt keine Kanten von Fassungen; mdft nehmen oder {parameter} weglassen</translation></message>
<message><source>an FFT of {samples} × {samples} pupil samples is too large; use mdft or change the pixel</source><translation>eine FFT von {samples} × {samples} Pupillenproben ist zu groß; mdft nehmen oder das Pixel ändern</translation></message>
<message><source>an afocal lens has no f-number; state the stop's semi-diameter</source><translation>ein afokales Objektiv hat keine Blendenzahl; den Halbmesser der Blende angeben</translation></message>
<message><source>an afocal lens has no f-number; state the stop's semi-diameter or the pupil's diameter</source><translation>ein afokales Objektiv hat keine Blendenzahl; den Halbmesser der Blende oder den Durchmesser der Pupille angeben</translation></message>
<message><source>an empty stack of PSFs has no width of its own; give the pixel in µm</source><translation>ein Stapel ohne PSFs hat keine eigene Breite; das Pixel in µm angeben</translation></message>
<message><source>an end of the sweep</source><translation>ein Ende des Durchlaufs</translation></message>
<message><source>an energy fraction of {fraction}; give a number between 0 and 1</source><translation>ein Energieanteil von {fraction}; eine Zahl zwischen 0 und 1 angeben</translation></message>
<message><source>an error of the build is at surfaces {value}; give the first and the last, counted from 1</source><translation>ein Fehler des Baus liegt an den Flächen {value}; die erste und die letzte angeben, ab 1 gezählt</translation></message>
<message><source>an error of the build is {value}; give kind, first and last surface, and amount; kinds are {kinds}</source><translation>ein Fehler des Baus ist {value}; Art, erste und letzte Fläche und Betrag angeben; Arten sind {kinds}</translation></message>
<message><source>an ideal lens that is not round</source><translation>eine ideale Linse, die nicht rund ist</translation></message>
<message><source>an object at infinity has no height; give the field as an angle or an image height</source><translation>ein Objekt im Unendlichen hat keine Höhe; das Feld als Winkel oder Bildhöhe angeben</translation></message>
<message><source>an object at infinity has no numerical aperture; state the pupil's diameter or f-number</source><translation>ein Objekt im Unendlichen hat keine numerische Apertur; Pupillendurchmesser oder Blendenzahl angeben</translation></message>
<message><source>an odd asphere has no normalisation radius; write type = "extended odd asphere"</source><translation>eine ungerade Asphäre hat keinen Normierungsradius; type = "extended odd asphere" schreiben</translation></message>
<message><source>aperture</source><translation>Öffnung</translation></message>
<message><source>aperture is {found}; write [aperture] and one of {names}</source><translation>aperture ist {found}; [aperture] und eines von {names} schreiben</translation></message>
<message><source>aperture {kind} is {value}; give a positive number</source><translation>die Öffnung {kind} ist {value}; eine positive Zahl angeben</translation></message>
<message><source>apodisation</source><translation>Apodisation</translation></message>
<message><source>apodisation power</source><translation>Potenz der Apodisation</translation></message>
<message><source>apodised</source><translation>apodisiert</translation></message>
<message><source>as designed</source><translation>wie entworfen</translation></message>
<message><source>as designed, worst field: {value}</source><translation>wie entworfen, schlechtestes Feld: {value}</translation></message>
<message><source>as designed, compensated, worst field: {value}</source><translation>wie entworfen, kompensiert, schlechtestes Feld: {value}</translation></message>
<message><source>as designed: {value}</source><translation>wie entworfen: {value}</translation></message>
<message><source>as in the file</source><translation>laut Datei</translation></message>
<message><source>as it is</source><translation>wie es ist</translation></message>
<message><source>ask for {mirror:.6g} {unit}, whose PSF is the same upside down, or build one that reaches there</source><translation>{mirror:.6g} {unit} verlangen, wo die PSF dieselbe kopfüber ist, oder eine bauen, die dorthin reicht</translation></message>
<message><source>ask inside, or build one that reaches there</source><translation>innerhalb fragen oder eine bauen, die dorthin reicht</translation></message>
<message><source>aspheric coefficient</source><translation>asphärischer Koeffizient</translation></message>
<message><source>aspherical data of "{name}", which is not a row of the lens data</source><translation>asphärische Daten von "{name}", was keine Zeile der Linsendaten ist</translation></message>
<message><source>aspherical value</source><translation>asphärischer Wert</translation></message>
<message><source>astigmatism</source><translation>Astigmatismus</translation></message>
<message><source>at ({x}, {y}) of the corner: share of the peak</source><translation>bei ({x}, {y}) der Ecke: Anteil der Spitze</translation></message>
<message><source>at infinity</source><translation>im Unendlichen</translation></message>
<message><source>at infinity, {field:.4g}°, {wave:.4g} nm</source><translation>im Unendlichen, {field:.4g}°, {wave:.4g} nm</translation></message>
<message><source>at {depth:.6g} mm, {field:.4g}°, {wave:.4g} nm</source><translation>bei {depth:.6g} mm, {field:.4g}°, {wave:.4g} nm</translation></message>
<message><source>at {wavelength} nm</source><translation>bei {wavelength} nm</translation></message>
<message><source>auto</source><translation>auto</translation></message>
<message><source>back focus</source><translation>Schnittweite zum Sensor</translation></message>
<message><source>back to the lens's own value</source><translation>zurück zum Wert des Objektivs</translation></message>
<message><source>barrel {part} at {field}</source><translation>Tonne {part} bei {field}</translation></message>
<message><source>begins a non-sequential part</source><translation>beginnt einen nicht sequentiellen Teil</translation></message>
<message><source>bending X = {shape}, R = {radii} mm</source><translation>Durchbiegung X = {shape}, R = {radii} mm</translation></message>
<message><source>best</source><translation>best</translation></message>
<message><source>best {shift} µm</source><translation>best {shift} µm</translation></message>
<message><source>between {depths} × {fields} × {wavelengths} nodes the fits are still wrong by {error:.2g} waves; narrow the depths, the fields or the wavelengths, or use the seidel method</source><translation>die Anpassungen liegen zwischen {depths} × {fields} × {wavelengths} Knoten noch um {error:.2g} Wellen daneben; Abstände, Felder oder Wellenlängen einengen oder das Verfahren seidel nehmen</translation></message>
<message><source>black body 5600 K</source><translation>Schwarzer Körper 5600 K</translation></message>
<message><source>blade angle</source><translation>Lamellenwinkel</translation></message>
<message><source>blink</source><translation>blinkend</translation></message>
<message><source>blue</source><translation>Blau</translation></message>
<message><source>blur to tolerate</source><translation>erlaubte Unschärfe</translation></message>
<message><source>blur, µm</source><translation>Unschärfe, µm</translation></message>
<message><source>blurred</source><translation>unscharf</translation></message>
<message><source>brightness</source><translation>Helligkeit</translation></message>
<message><source>bring focus and source together to see waves</source><translation>Fokus und Quelle zusammenbringen, um Wellen zu sehen</translation></message>
<message><source>build</source><translation>Exemplar</translation></message>
<message><source>build a fitted one, or align it</source><translation>eine angepasste (fitted) erstellen oder sie gerade stellen</translation></message>
<message><source>build {number}</source><translation>Exemplar {number}</translation></message>
<message><source>build {number}: {value} · tilts and decentres ×{factor}, rays as they are</source><translation>Exemplar {number}: {value} · Kippungen und Dezentrierungen ×{factor}, Strahlen wie sie sind</translation></message>
<message><source>builds</source><translation>Exemplare</translation></message>
<message><source>by R²</source><translation>nach R²</translation></message>
<message><source>by field</source><translation>nach Feld</translation></message>
<message><source>by hand</source><translation>von Hand</translation></message>
<message><source>by kind</source><translation>nach Art</translation></message>
<message><source>by the MTF</source><translation>nach der MTF</translation></message>
<message><source>by the axis's PSF</source><translation>mit der PSF der Achse</translation></message>
<message><source>by the radius R80</source><translation>nach dem Radius R80</translation></message>
<message><source>by faint light</source><translation>nach schwachem Licht</translation></message>
<message><source>by time</source><translation>nach Zeit</translation></message>
<message><source>by wavelength</source><translation>nach Wellenlänge</translation></message>
<message><source>bytes of all PSFs of the lens</source><translation>Bytes aller PSFs des Objektivs</translation></message>
<message><source>cannot compare {psf} with {reference}; render both on the same grid</source><translation>{psf} und {reference} sind nicht vergleichbar; beide auf demselben Gitter rechnen</translation></message>
<message><source>centre_mm has {count} numbers; give two, x and y</source><translation>centre_mm hat {count} Zahlen; zwei angeben, x und y</translation></message>
<message><source>change it; a click types</source><translation>ändert sie; ein Klick beginnt zu tippen</translation></message>
<message><source>channel {channel} has a wavelength or weight that is not positive; correct it</source><translation>der Kanal {channel} hat eine Wellenlänge oder ein Gewicht, das nicht positiv ist; berichtigen</translation></message>
<message><source>channel {channel} has {waves} wavelengths and {weights} weights; give as many of both, at least one</source><translation>der Kanal {channel} hat {waves} Wellenlängen und {weights} Gewichte; von beiden gleich viele angeben, mindestens eines</translation></message>
<message><source>channel {channel}: {error}</source><translation>Kanal {channel}: {error}</translation></message>
<message><source>chart "{name}" is unknown; {hint}</source><translation>die Tafel "{name}" ist unbekannt; {hint}</translation></message>
<message><source>chief ray</source><translation>Hauptstrahl</translation></message>
<message><source>chief ray ȳ, mm</source><translation>Hauptstrahl ȳ, mm</translation></message>
<message><source>chief ray, µm</source><translation>Hauptstrahl, µm</translation></message>
<message><source>chief rays do not land in a smooth order on the sensor, by {miss:.2g} pixels; take a smaller sensor or align the lens better</source><translation>Hauptstrahlen treffen den Sensor in keiner glatten Ordnung, um {miss:.2g} Pixel; einen kleineren Sensor nehmen oder das Objektiv gerader stellen</translation></message>
<message><source>chief rays do not reach all of the sensor; take a smaller sensor</source><translation>Hauptstrahlen erreichen nicht den ganzen Sensor; einen kleineren Sensor nehmen</translation></message>
<message><source>choose a folder that is one</source><translation>einen Ordner wählen, der einer ist</translation></message>
<message><source>choose a folder you may write to</source><translation>einen Ordner wählen, in den Sie schreiben dürfen</translation></message>
<message><source>choose a photo that was taken through this lens by Photo…, or drop it here: a chart was not</source><translation>ein Foto, das dieses Objektiv aufgenommen hat, mit Foto … wählen oder hier ablegen: eine Tafel ist keines</translation></message>
<message><source>choose a smaller field or stop down</source><translation>ein kleineres Feld wählen oder abblenden</translation></message>
<message><source>choose a smaller field, stop down, or leave clipping off</source><translation>ein kleineres Feld wählen, abblenden oder den Randbeschnitt auslassen</translation></message>
<message><source>choose another place</source><translation>einen anderen Ort wählen</translation></message>
<message><source>choose fewer pixels or another disk</source><translation>weniger Pixel oder einen anderen Datenträger wählen</translation></message>
<message><source>choose how large the pixels of the camera are; To Image in Measured states those of the measured picture</source><translation>wählen, wie groß die Pixel der Kamera sind; Ins Bild in Gemessen stellt die des gemessenen Bildes ein</translation></message>
<message><source>choose {names}</source><translation>{names} wählen</translation></message>
<message><source>clear</source><translation>frei</translation></message>
<message><source>clear rim</source><translation>freier Rand</translation></message>
<message><source>click or P, L</source><translation>Klick oder P, L</translation></message>
<message><source>clipped by the clear semi-diameters</source><translation>an den freien Halbmessern beschnitten</translation></message>
<message><source>coarse</source><translation>grob</translation></message>
<message><source>coatings, polarisation, scatter</source><translation>Beschichtungen, Polarisation, Streuung</translation></message>
<message><source>coefficient</source><translation>Koeffizient</translation></message>
<message><source>coefficient of a phase</source><translation>Koeffizient einer Phase</translation></message>
<message><source>coefficient, waves</source><translation>Koeffizient, Wellen</translation></message>
<message><source>coefficients are {count} numbers; write 1 to {most}</source><translation>coefficients sind {count} Zahlen; 1 bis {most} schreiben</translation></message>
<message><source>coefficients of {name} are not up to {count} numbers; correct them</source><translation>die Koeffizienten von {name} sind nicht bis zu {count} Zahlen; berichtigen</translation></message>
<message><source>colour {channel}</source><translation>Farbe {channel}</translation></message>
<message><source>colour {short} − {long} nm</source><translation>Farbe {short} − {long} nm</translation></message>
<message><source>column "{name}" is unknown</source><translation>die Spalte "{name}" ist unbekannt</translation></message>
<message><source>column {column}</source><translation>Spalte {column}</translation></message>
<message><source>column {name} is missing</source><translation>die Spalte {name} fehlt</translation></message>
<message><source>columns is {found}; write at least two names, as in ["wide", "tele"]</source><translation>columns ist {found}; mindestens zwei Namen schreiben, etwa ["wide", "tele"]</translation></message>
<message><source>coma</source><translation>Koma</translation></message>
<message><source>commas</source><translation>Kommas</translation></message>
<message><source>commercial grade</source><translation>Klasse handelsüblich</translation></message>
<message><source>compensators {places} are not among the {count} tolerances</source><translation>Kompensatoren {places} sind nicht unter den {count} Toleranzen</translation></message>
<message><source>computing</source><translation>rechnet</translation></message>
<message><source>computing settings</source><translation>Recheneinstellungen</translation></message>
<message><source>computing, {percent} %</source><translation>rechnet, {percent} %</translation></message>
<message><source>configuration</source><translation>Konfiguration</translation></message>
<message><source>configurations differ in {names}, which are not read; all have those of the surfaces</source><translation>Konfigurationen unterscheiden sich in {names}, was nicht gelesen wird; alle haben das der Flächen</translation></message>
<message><source>conic constant</source><translation>Kegelschnittkonstante</translation></message>
<message><source>contour</source><translation>Höhenlinien</translation></message>
<message><source>contours</source><translation>Höhenlinien</translation></message>
<message><source>contrast</source><translation>Kontrast</translation></message>
<message><source>contrast (MTF)</source><translation>Kontrast (MTF)</translation></message>
<message><source>contrast {value} at {frequency:g} /mm</source><translation>Kontrast {value} bei {frequency:g} /mm</translation></message>
<message><source>contrast ≥ {limit}</source><translation>Kontrast ≥ {limit}</translation></message>
<message><source>control codes of the optimiser</source><translation>Steuerzeichen der Optimierung</translation></message>
<message><source>corner {field}</source><translation>Ecke {field}</translation></message>
<message><source>correct the line</source><translation>die Zeile berichtigen</translation></message>
<message><source>cos⁴ of a pinhole</source><translation>cos⁴ einer Lochkamera</translation></message>
<message><source>could not be aimed at its place in the stop, surface {surface}</source><translation>ließ sich nicht auf seinen Ort in der Blende richten, Fläche {surface}</translation></message>
<message><source>cubic phase</source><translation>kubische Phase</translation></message>
<message><source>curvature</source><translation>Krümmung</translation></message>
<message><source>cut by the frame's edge</source><translation>vom Rand der Aufnahme angeschnitten</translation></message>
<message><source>data</source><translation>Daten</translation></message>
<message><source>daylight D65</source><translation>Tageslicht D65</translation></message>
<message><source>decentre</source><translation>Dezentrierung</translation></message>
<message><source>decentre x, surface {where}</source><translation>Dezentrierung x, Fläche {where}</translation></message>
<message><source>decentre y {amount} mm</source><translation>Dezentrierung y {amount} mm</translation></message>
<message><source>decentre y, surface {where}</source><translation>Dezentrierung y, Fläche {where}</translation></message>
<message><source>decimal separator</source><translation>,</translation></message>
<message><source>defocus by {causes}</source><translation>Defokus durch {causes}</translation></message>
<message><source>defocus</source><translation>Defokus</translation></message>
<message><source>defocus grows with 1/distance, so nodes stand at equal steps of it</source><translation>die Defokussierung wächst mit 1/Abstand, daher stehen die Knoten in gleichen Schritten davon</translation></message>
<message><source>degrees</source><translation>Grad</translation></message>
<message><source>density of {radii} × {directions} rays; diffraction is too fine to see here</source><translation>Dichte von {radii} × {directions} Strahlen; die Beugung ist hier zu fein, um sie zu sehen</translation></message>
<message><source>depth</source><translation>Objektabstand</translation></message>
<message><source>depth is {depth:g} mm; the object must be a positive distance in front of the first vertex</source><translation>der Objektabstand ist {depth:g} mm; das Objekt muss in einem positiven Abstand vor dem ersten Scheitel stehen</translation></message>
<message><source>depth is {given}; write a table [depth] with near_mm, far_mm or map under it</source><translation>depth ist {given}; eine Tabelle [depth] schreiben, darunter near_mm, far_mm oder map</translation></message>
<message><source>depth {depth:.6g} mm lies between the last finite node, {last:.6g} mm, and infinity, where table1 has no rule; add nodes or build with the exact interpolant</source><translation>der Objektabstand {depth:.6g} mm liegt zwischen dem letzten endlichen Knoten, {last:.6g} mm, und unendlich, wo table1 keine Regel hat; Knoten hinzufügen oder mit der Interpolation exact bauen</translation></message>
<message><source>depth {depth:g} mm is not in front of the lens; give positive depths</source><translation>der Objektabstand {depth:g} mm liegt nicht vor dem Objektiv; positive Abstände angeben</translation></message>
<message><source>depth, even in 1/depth</source><translation>Abstand, gleichmäßig in 1/Abstand</translation></message>
<message><source>diameter</source><translation>Durchmesser</translation></message>
<message><source>did you mean {glasses}?</source><translation>ist {glasses} gemeint?</translation></message>
<message><source>did you mean {name}?</source><translation>ist {name} gemeint?</translation></message>
<message><source>difference</source><translation>Differenz</translation></message>
<message><source>difference, % of the peak</source><translation>Differenz, % der Spitze</translation></message>
<message><source>diffractive</source><translation>diffraktiv</translation></message>
<message><source>diffracts</source><translation>beugt</translation></message>
<message><source>diffracts in order {order:g}: normalisation radius {radius:g} mm, phase in rad of ρ², ρ⁴, … {numbers:.6g}</source><translation>beugt in Ordnung {order:g}: Normierungsradius {radius:g} mm, Phase in rad von ρ², ρ⁴, … {numbers:.6g}</translation></message>
<message><source>distance</source><translation>Abstand</translation></message>
<message><source>distance "{name}" has no value in [variable distances]; add it</source><translation>der Abstand "{name}" hat keinen Wert in [variable distances]; hinzufügen</translation></message>
<message><source>distance from the chief ray, µm</source><translation>Entfernung vom Hauptstrahl, µm</translation></message>
<message><source>distortion</source><translation>Verzeichnung</translation></message>
<message><source>distortion of colours</source><translation>Verzeichnung der Farben</translation></message>
<message><source>distortion, %</source><translation>Verzeichnung, %</translation></message>
<message><source>distortion, third order</source><translation>Verzeichnung, dritte Ordnung</translation></message>
<message><source>double-click</source><translation>Doppelklick</translation></message>
<message><source>drag or wheel on a number</source><translation>auf einer Zahl ziehen oder das Rad drehen</translation></message>
<message><source>drawing and editor settings</source><translation>Einstellungen für Zeichnung und Editor</translation></message>
<message><source>drawn {times} times</source><translation>{times}fach gezeichnet</translation></message>
<message><source>drop a file</source><translation>Datei fallen lassen</translation></message>
<message><source>duration</source><translation>Dauer</translation></message>
<message><source>duration of a sweep</source><translation>Dauer eines Durchlaufs</translation></message>
<message><source>earlier picture</source><translation>früheres Bild</translation></message>
<message><source>earlier picture, working</source><translation>früheres Bild, in Arbeit</translation></message>
<message><source>edited</source><translation>bearbeitet</translation></message>
<message><source>edited since</source><translation>seither geändert</translation></message>
<message><source>element {number}, surfaces {first} to {last}</source><translation>Linse {number}, Flächen {first} bis {last}</translation></message>
<message><source>ending "{ending}" is none of {endings}; choose one</source><translation>die Endung "{ending}" ist keine von {endings}; eine davon wählen</translation></message>
<message><source>energy within</source><translation>Energie innerhalb</translation></message>
<message><source>enlargement of the 3D view</source><translation>Vergrößerung der 3D-Ansicht</translation></message>
<message><source>entrance pupil diameter</source><translation>Durchmesser der Eintrittspupille</translation></message>
<message><source>entrance pupil diameter {value:.6g} mm</source><translation>Durchmesser der Eintrittspupille {value:.6g} mm</translation></message>
<message><source>equal energy</source><translation>gleiche Energie</translation></message>
<message><source>error</source><translation>Fehler</translation></message>
<message><source>error of linear interpolation</source><translation>Fehler der linearen Interpolation</translation></message>
<message><source>error of table 1 of the paper</source><translation>Fehler von Tabelle 1 des Aufsatzes</translation></message>
<message><source>errors is {value}; give a list of kind, first and last surface, and amount</source><translation>errors ist {value}; eine Liste aus Art, erster und letzter Fläche und Betrag angeben</translation></message>
<message><source>every chief ray meets the sensor on the axis, so it contains no picture; move the stop</source><translation>jeder Hauptstrahl trifft den Sensor auf der Achse, also enthält er kein Bild; die Blende verschieben</translation></message>
<message><source>every chief ray meets the sensor on the axis; give the field as an angle</source><translation>jeder Hauptstrahl trifft den Sensor auf der Achse; das Feld als Winkel angeben</translation></message>
<message><source>every medium of this lens has the index {index:g}, so no surface bends light; state its glasses</source><translation>jedes Medium dieses Objektivs hat den Brechungsindex {index:g}, also bricht keine Fläche das Licht; seine Gläser nennen</translation></message>
<message><source>every pixel</source><translation>jedes Pixel</translation></message>
<message><source>map…</source><translation>Karte …</translation></message>
<message><source>exact</source><translation>genau</translation></message>
<message><source>exact rays</source><translation>exakte Strahlen</translation></message>
<message><source>exact rays, which cost a single picture no more than a fit, where six coefficients may leave 1 − R² = {error:.1e}</source><translation>exakte Strahlen, die für ein einzelnes Bild nicht mehr kosten als eine Anpassung, wo sechs Koeffizienten 1 − R² = {error:.1e} lassen können</translation></message>
<message><source>exact rays, since {because}</source><translation>exakte Strahlen, denn {because}</translation></message>
<message><source>exact rays, this field</source><translation>exakt, dieses Feld</translation></message>
<message><source>exaggeration of tilts and decentres</source><translation>Überhöhung von Kippungen und Dezentrierungen</translation></message>
<message><source>extended asphere</source><translation>erweiterte Asphäre</translation></message>
<message><source>extended odd asphere</source><translation>erweiterte ungerade Asphäre</translation></message>
<message><source>extra data</source><translation>Zusatzdaten</translation></message>
<message><source>f number</source><translation>Blendenzahl</translation></message>
<message><source>f number {value:.6g}</source><translation>Blendenzahl {value:.6g}</translation></message>
<message><source>f-number</source><translation>Blendenzahl</translation></message>
<message><source>f-number N = f′/D: focal length over the diameter of the entrance pupil.</source><translation>Blendenzahl N = f′/D: Brennweite durch den Durchmesser der Eintrittspupille.</translation></message>
<message><source>f-number flag</source><translation>Kennzeichen der Blendenzahl</translation></message>
<message><source>fast</source><translation>schnell</translation></message>
<message><source>field</source><translation>Feld</translation></message>
<message><source>field angle</source><translation>Feldwinkel</translation></message>
<message><source>field angle along x</source><translation>Feldwinkel entlang x</translation></message>
<message><source>field angle {angle:g}° is not below 90°; correct it</source><translation>der Feldwinkel {angle:g}° liegt nicht unter 90°; berichtigen</translation></message>
<message><source>field curvature</source><translation>Bildfeldwölbung</translation></message>
<message><source>field heights have no angle for this lens</source><translation>Feldhöhen haben bei diesem Objektiv keinen Winkel</translation></message>
<message><source>field type</source><translation>Feldtyp</translation></message>
<message><source>field type {kind} is none of 0 to 3; choose angle or height</source><translation>der Feldtyp {kind} ist keiner von 0 bis 3; Winkel oder Höhe wählen</translation></message>
<message><source>field x</source><translation>Feld x</translation></message>
<message><source>field y</source><translation>Feld y</translation></message>
<message><source>field, °</source><translation>Feld, °</translation></message>
<message><source>fields along x {angles:.4g}°</source><translation>Felder entlang x {angles:.4g}°</translation></message>
<message><source>fields given as {kind} are kept as angles at the entrance pupil</source><translation>als {kind} gegebene Felder werden als Winkel an der Eintrittspupille geführt</translation></message>
<message><source>figures are of one PSF of two samples a side or more, and this one has the shape {shape}; ask for one after the other</source><translation>Zahlen gibt es von einer PSF mit zwei oder mehr Abtastwerten je Seite, und diese hat die Form {shape}; eine nach der anderen fragen</translation></message>
<message><source>file</source><translation>Datei</translation></message>
<message><source>fill factor</source><translation>Füllfaktor</translation></message>
<message><source>fitted</source><translation>fitted</translation></message>
<message><source>fitted 26</source><translation>fitted 26</translation></message>
<message><source>fitted 46</source><translation>fitted 46</translation></message>
<message><source>fitted adaptive</source><translation>fitted adaptiv</translation></message>
<message><source>fitted numbers</source><translation>angepasste Zahlen</translation></message>
<message><source>fitted: polynomial from real rays</source><translation>fitted: Polynom aus wahren Strahlen</translation></message>
<message><source>focus</source><translation>Fokus</translation></message>
<message><source>focus behind the sensor, mm</source><translation>Fokus hinter dem Sensor, mm</translation></message>
<message><source>focus distance</source><translation>Fokusabstand</translation></message>
<message><source>focus positions {columns}; between them the lens is interpolated</source><translation>Fokusstellungen {columns}; dazwischen wird das Objektiv interpoliert</translation></message>
<message><source>focus {place}</source><translation>Fokus {place}</translation></message>
<message><source>focus, µm</source><translation>Fokus, µm</translation></message>
<message><source>focused at {distance} · {column}</source><translation>fokussiert auf {distance} · {column}</translation></message>
<message><source>formula number</source><translation>Formelnummer</translation></message>
<message><source>formula {formula} of {name} gives no real index there; check its coefficients</source><translation>Formel {formula} von {name} ergibt dort keinen reellen Index; ihre Koeffizienten prüfen</translation></message>
<message><source>found</source><translation>gefunden</translation></message>
<message><source>fr.</source><translation>Ringe</translation></message>
<message><source>free pupil</source><translation>freie Pupille</translation></message>
<message><source>free some space or choose another disk</source><translation>Platz schaffen oder einen anderen Datenträger wählen</translation></message>
<message><source>frequency on the sensor, 1/mm</source><translation>Ortsfrequenz auf dem Sensor, 1/mm</translation></message>
<message><source>from</source><translation>von</translation></message>
<message><source>front group</source><translation>vordere Gruppe</translation></message>
<message><source>predicted error up to {error:.1g}</source><translation>vorhergesagter Fehler bis {error:.1g}</translation></message>
<message><source>geometric limit, by the landing points of rays</source><translation>geometrischer Grenzfall, aus den Auftreffpunkten der Strahlen</translation></message>
<message><source>geometric limit, by the landing points of rays: departs from waves by up to {departure:.1g}, not to be trusted beyond that</source><translation>geometrischer Grenzfall, aus den Auftreffpunkten der Strahlen: weicht von Wellen um bis zu {departure:.1g} ab, darüber hinaus nicht verlässlich</translation></message>
<message><source>How to give the first lecture</source><translation>Die erste Vorlesung halten</translation></message>
<message><source>Date</source><translation>Datum</translation></message>
<message><source>Each page is in the window under Course…, and a file beside this sheet opens it.</source><translation>Jede Seite steht im Fenster unter Kurs …, und eine Datei neben diesem Blatt öffnet sie.</translation></message>
<message><source>For the lecturer</source><translation>Für die Lehrperson</translation></message>
<message><source>Hint {number}</source><translation>Hinweis {number}</translation></message>
<message><source>A mistake to expect</source><translation>Ein Fehler, der zu erwarten ist</translation></message>
<message><source>Solution</source><translation>Lösung</translation></message>
<message><source>Who answers {answer}</source><translation>Wer {answer} antwortet</translation></message>
<message><source>{path} cannot be made ({reason}); choose another folder</source><translation>{path} kann nicht angelegt werden ({reason}); wählen Sie einen anderen Ordner</translation></message>
<message><source>{parameter} is {value}; choose one of {choices}</source><translation>{parameter} ist {value}; wählen Sie eines aus {choices}</translation></message>
<message><source>{title}: solutions and notes</source><translation>{title}: Lösungen und Hinweise</translation></message>
<message><source>geometric: ray density, no diffraction</source><translation>geometrisch: Strahlendichte, keine Beugung</translation></message>
<message><source>geometric: ray density, no diffraction; {percent:.0f} % of the light in the window</source><translation>geometrisch: Strahlendichte, keine Beugung; {percent:.0f} % des Lichts im Fenster</translation></message>
<message><source>give fields along x as well, or align it</source><translation>auch Felder längs x angeben oder sie gerade stellen</translation></message>
<message><source>give the name of a file in it</source><translation>den Namen einer Datei darin angeben</translation></message>
<message><source>glass "{name}"</source><translation>Glas "{name}"</translation></message>
<message><source>glass "{name}" is a table of {count:d} points, too long to be shipped; write the points you need as {{ wavelengths_um = […], n = […] }}</source><translation>das Glas "{name}" ist eine Tabelle von {count:d} Punkten, zu lang, um beizuliegen; die gebrauchten Punkte als {{ wavelengths_um = […], n = […] }} schreiben</translation></message>
<message><source>glass "{name}" is in no catalogue; {suggestion}</source><translation>das Glas "{name}" steht in keinem Katalog; {suggestion}</translation></message>
<message><source>glass "{name}" is listed with its absorption only; give its index or nd and vd</source><translation>das Glas "{name}" ist nur mit seiner Absorption verzeichnet; seinen Index oder nd und vd angeben</translation></message>
<message><source>glass "{name}" is not among the shipped pages of refractiveindex.info; check shelf/book/page</source><translation>das Glas "{name}" ist keine der beiliegenden Seiten von refractiveindex.info; shelf/book/page prüfen</translation></message>
<message><source>glass "{name}" is not in the catalogue of {maker}; {suggestion}</source><translation>das Glas "{name}" steht nicht im Katalog von {maker}; {suggestion}</translation></message>
<message><source>glass "{name}" is sold with different indices as {glasses}; write the one you mean</source><translation>das Glas "{name}" wird mit verschiedenen Indizes verkauft als {glasses}; das gemeinte schreiben</translation></message>
<message><source>glass "{name}" of {makers}</source><translation>Glas "{name}" von {makers}</translation></message>
<message><source>glass catalogue {path} with {count} glasses was found</source><translation>der Glaskatalog {path} mit {count} Gläsern liegt bei</translation></message>
<message><source>glass has the keys {names}; write {known}</source><translation>glass hat die Schlüssel {names}; {known} schreiben</translation></message>
<message><source>glass is {found}; write a name such as "SCHOTT N-BK7", an index, or nd and vd</source><translation>glass ist {found}; einen Namen wie "SCHOTT N-BK7", einen Index oder nd und vd schreiben</translation></message>
<message><source>glass is {found}; write {{ nd = 1.5168, vd = 64.17 }} or {{ wavelengths_um = […], n = […] }}</source><translation>glass ist {found}; {{ nd = 1.5168, vd = 64.17 }} oder {{ wavelengths_um = […], n = […] }} schreiben</translation></message>
<message><source>glass table needs two equally long lists of numbers; give wavelengths_um and n</source><translation>die Glastabelle braucht zwei gleich lange Listen von Zahlen; wavelengths_um und n angeben</translation></message>
<message><source>glass table's wavelengths are {wavelengths} µm; put them in ascending order</source><translation>die Wellenlängen der Glastabelle sind {wavelengths} µm; aufsteigend ordnen</translation></message>
<message><source>glass {name} is {own:.5f} at d; nd {nd:g} and vd {vd:g} of the same row are taken</source><translation>Glas {name} hat bei d {own:.5f}; nd {nd:g} und vd {vd:g} derselben Zeile gelten</translation></message>
<message><source>glass {name} is not known by name; its nd {nd:g} and vd {vd:g} of the same row are taken</source><translation>Glas {name} ist dem Namen nach unbekannt; nd {nd:g} und vd {vd:g} derselben Zeile gelten</translation></message>
<message><source>glass {name} of {path} has nd {nd:.5f} by its coefficients and {listed:.5f} by its name line; the catalogue is damaged, replace it</source><translation>das Glas {name} aus {path} hat nd {nd:.5f} nach seinen Koeffizienten und {listed:.5f} nach seiner Namenszeile; der Katalog ist beschädigt, ersetzen</translation></message>
<message><source>glass's nd or vd</source><translation>nd oder vd des Glases</translation></message>
<message><source>grade is "{grade}"; write one of {grades}</source><translation>grade ist "{grade}"; eines von {grades} schreiben</translation></message>
<message><source>green</source><translation>Grün</translation></message>
<message><source>half-width of a rim</source><translation>halbe Breite eines Randes</translation></message>
<message><source>has a shape that is not a sphere, a conic or an asphere in powers of r</source><translation>hat eine Form, die keine Kugel, kein Kegelschnitt und keine Asphäre in Potenzen von r ist</translation></message>
<message><source>has a shape that is not a sphere, a conic or an even asphere</source><translation>hat eine Form, die weder Kugel noch Kegelschnitt noch gerade Asphäre ist</translation></message>
<message><source>has no diffracted direction behind surface {surface}, whose phase is too steep there</source><translation>hat hinter Fläche {surface} keine gebeugte Richtung, deren Phase dort zu steil ist</translation></message>
<message><source>high precision grade</source><translation>Klasse hochpräzise</translation></message>
<message><source>huygens</source><translation>huygens</translation></message>
<message><source>huygens: the reference sum</source><translation>huygens: die Referenzsumme</translation></message>
<message><source>ideal lens</source><translation>ideale Linse</translation></message>
<message><source>ideal lens: focal length {focal:g} mm</source><translation>ideale Linse: Brennweite {focal:g} mm</translation></message>
<message><source>ignored, without effect on the picture</source><translation>übergangen, ohne Wirkung auf das Bild</translation></message>
<message><source>image</source><translation>Bild</translation></message>
<message><source>image f number</source><translation>bildseitige Blendenzahl</translation></message>
<message><source>image heights</source><translation>Bildhöhen</translation></message>
<message><source>image method "{method}" is unknown; choose {choices}</source><translation>das Bildverfahren "{method}" ist unbekannt; {choices} wählen</translation></message>
<message><source>image na</source><translation>bildseitige NA</translation></message>
<message><source>image shifted by {value} µm</source><translation>Bild um {value} µm verschoben</translation></message>
<message><source>image {h} mm</source><translation>Bild {h} mm</translation></message>
<message><source>in</source><translation>in</translation></message>
<message><source>index</source><translation>Index</translation></message>
<message><source>index 0 behind a curved surface is read as air, as PBRT does</source><translation>Index 0 hinter einer gekrümmten Fläche wird als Luft gelesen, wie in PBRT</translation></message>
<message><source>index behind surface {where}</source><translation>Brechzahl hinter Fläche {where}</translation></message>
<message><source>infinity</source><translation>unendlich</translation></message>
<message><source>inner radius</source><translation>Innenradius</translation></message>
<message><source>interpolant "{interpolant}" is unknown; choose {interpolants}</source><translation>die Interpolation "{interpolant}" ist unbekannt; {interpolants} wählen</translation></message>
<message><source>interpolation between a few of them does not give the others</source><translation>keine Polynome durch wenige von ihnen ergeben die übrigen</translation></message>
<message><source>ipywidgets is not installed; run pip install 'p2sf[notebook]'</source><translation>ipywidgets ist nicht installiert; pip install 'p2sf[notebook]' ausführen</translation></message>
<message><source>irregularity</source><translation>Passfehler</translation></message>
<message><source>irregularity at 45°, surface {where}</source><translation>Passfehler unter 45°, Fläche {where}</translation></message>
<message><source>irregularity, surface {where}</source><translation>Passfehler, Fläche {where}</translation></message>
<message><source>is a Fresnel surface</source><translation>ist eine Fresnel-Fläche</translation></message>
<message><source>is a lens module that hides its surfaces</source><translation>ist ein Linsenmodul, das seine Flächen verbirgt</translation></message>
<message><source>is followed by a gradient index</source><translation>wird von einem Gradientenindex gefolgt</translation></message>
<message><source>is stopped by the rim of surface {surface}</source><translation>wird vom Rand der Fläche {surface} aufgehalten</translation></message>
<message><source>is tilted or decentred</source><translation>ist gekippt oder dezentriert</translation></message>
<message><source>is tilted or decentred otherwise than by XDE to CDE</source><translation>ist anders als durch XDE bis CDE gekippt oder dezentriert</translation></message>
<message><source>meets surface {surface} where that transmits no light</source><translation>trifft Fläche {surface} dort, wo sie kein Licht durchlässt</translation></message>
<message><source>is totally reflected at surface {surface}</source><translation>wird an Fläche {surface} total reflektiert</translation></message>
<message><source>its PSFs, as a map</source><translation>seine PSFs als Karte</translation></message>
<message><source>its diffraction</source><translation>ihre Beugung</translation></message>
<message><source>its obscuration is left out, so the picture shows the full aperture</source><translation>ihre Abschattung ist weggelassen, das Bild zeigt also die volle Öffnung</translation></message>
<message><source>its rim ({keyword}) is not round; the round semi-diameter is used instead</source><translation>ihr Rand ({keyword}) ist nicht rund; der runde Halbmesser tritt an seine Stelle</translation></message>
<message><source>its shape</source><translation>ihre Form</translation></message>
<message><source>its tilt or decentre</source><translation>ihre Kippung oder Dezentrierung</translation></message>
<message><source>keep best focus</source><translation>besten Fokus halten</translation></message>
<message><source>keep paraxial focus</source><translation>paraxialen Fokus halten</translation></message>
<message><source>kernels in the middle of a cell are then the mean of its corners</source><translation>Kerne mitten in einer Zelle sind dann das Mittel ihrer Ecken</translation></message>
<message><source>key "{name}" belongs to the top of the file; move it before the first [ heading</source><translation>der Schlüssel "{name}" gehört an den Anfang der Datei; vor die erste Überschrift [ stellen</translation></message>
<message><source>key "{name}" is unknown; did you mean "{known}"?</source><translation>der Schlüssel "{name}" ist unbekannt; ist "{known}" gemeint?</translation></message>
<message><source>key "{name}" is unknown; known here are {known}</source><translation>der Schlüssel "{name}" ist unbekannt; hier bekannt sind {known}</translation></message>
<message><source>kinds of aperture</source><translation>Arten der Öffnung</translation></message>
<message><source>landing point, µm</source><translation>Landepunkt, µm</translation></message>
<message><source>largest difference of contrast</source><translation>größter Unterschied des Kontrasts</translation></message>
<message><source>largest error in {name}: exact {error} λ</source><translation>größter Fehler in {name}: exakt {error} λ</translation></message>
<message><source>lateral colour</source><translation>Farbquerfehler</translation></message>
<message><source>lateral colour {shift} µm</source><translation>Farbquerfehler {shift} µm</translation></message>
<message><source>lateral colour, µm</source><translation>Farbquerfehler, µm</translation></message>
<message><source>lengths converted to mm from units of {unit:g} mm</source><translation>Längen in mm umgerechnet aus Einheiten von {unit:g} mm</translation></message>
<message><source>lens "{name}" is neither shipped nor a file; did you mean {lenses}?</source><translation>das Objektiv "{name}" ist weder mitgeliefert noch eine Datei; ist {lenses} gemeint?</translation></message>
<message><source>lens "{name}" is neither shipped nor a file; shipped are {lenses}</source><translation>das Objektiv "{name}" ist weder mitgeliefert noch eine Datei; mitgeliefert sind {lenses}</translation></message>
<message><source>lens unit "{unit}" is none of M (mm), C, I; correct it</source><translation>die Längeneinheit "{unit}" ist keine von M (mm), C, I; berichtigen</translation></message>
<message><source>lens unit "{unit}" is none of MM, CM, IN, M; correct it</source><translation>die Längeneinheit "{unit}" ist keine von MM, CM, IN, M; berichtigen</translation></message>
<message><source>lens unit "{unit}" is none of {units}; correct it</source><translation>Die Längeneinheit „{unit}“ ist keine von {units}; bitte berichtigen</translation></message>
<message><source>lens unit "{unit}" is not in mm; correct it</source><translation>Die Längeneinheit „{unit}“ ist nicht in mm angegeben; bitte berichtigen</translation></message>
<message><source>limit of the criterion</source><translation>Grenze des Kriteriums</translation></message>
<message><source>line every {step} λ</source><translation>Linie alle {step} λ</translation></message>
<message><source>line {line}: {message}</source><translation>Zeile {line}: {message}</translation></message>
<message><source>linear</source><translation>linear</translation></message>
<message><source>linear {error} λ, on {depths} depths × {fields} fields × {waves} wavelengths</source><translation>linear {error} λ, auf {depths} Abständen × {fields} Feldern × {waves} Wellenlängen</translation></message>
<message><source>lines F d C</source><translation>Linien F d C</translation></message>
<message><source>listed nd</source><translation>verzeichnetes nd</translation></message>
<message><source>lists are nested too deep or a number is too long; this is not a lens file</source><translation>Listen sind zu tief verschachtelt oder eine Zahl ist zu lang; das ist keine Objektivdatei</translation></message>
<message><source>locked peak</source><translation>feste Spitze</translation></message>
<message><source>log</source><translation>log</translation></message>
<message><source>log, 8 decades</source><translation>log, 8 Dekaden</translation></message>
<message><source>logarithm of brightness</source><translation>Logarithmus der Helligkeit</translation></message>
<message><source>luminance</source><translation>Leuchtdichte</translation></message>
<message><source>luminance, peak = 1</source><translation>Leuchtdichte, Spitze = 1</translation></message>
<message><source>macOS learns what a program opens from its bundle; put P2SF Explorer.app into Applications</source><translation>macOS erfährt aus dem Programmpaket, was ein Programm öffnet; P2SF Explorer.app in den Ordner Programme legen</translation></message>
<message><source>make the folder first or choose another</source><translation>den Ordner zuerst anlegen oder einen anderen wählen</translation></message>
<message><source>marginal ray y, mm</source><translation>Randstrahl y, mm</translation></message>
<message><source>marginal rays, axial point</source><translation>Randstrahlen, Achspunkt</translation></message>
<message><source>marker</source><translation>Marke</translation></message>
<message><source>max {value} µm</source><translation>max. {value} µm</translation></message>
<message><source>max {value} λ</source><translation>max. {value} λ</translation></message>
<message><source>measure "{measure}" is unknown; choose one of {choices}</source><translation>das Maß "{measure}" ist unbekannt; eines von {choices} wählen</translation></message>
<message><source>measured</source><translation>gemessen</translation></message>
<message><source>measuring</source><translation>misst</translation></message>
<message><source>measuring what each method takes here</source><translation>es wird gemessen, wie lange jedes Verfahren hier braucht</translation></message>
<message><source>measuring, {percent} %</source><translation>misst, {percent} %</translation></message>
<message><source>medium {name} cannot be written to a file; give an index, a glass name or nd and vd</source><translation>das Medium {name} lässt sich nicht in eine Datei schreiben; einen Index, einen Glasnamen oder nd und vd angeben</translation></message>
<message><source>medium {name} has no line in a Zemax file; save as TOML, or give nd and vd</source><translation>das Medium {name} hat keine Zeile in einer Zemax-Datei; als TOML speichern oder nd und vd angeben</translation></message>
<message><source>meets surface {surface} {height:.4g} mm from its vertex, beyond its rim of {rim:g} mm</source><translation>trifft Fläche {surface} {height:.4g} mm neben ihrem Scheitel, außerhalb ihres Randes von {rim:g} mm</translation></message>
<message><source>meets the asphere on surface {surface} where no reliable intersection was found</source><translation>trifft die Asphäre auf Fläche {surface}, wo kein sicherer Schnittpunkt zu finden war</translation></message>
<message><source>mercury g e</source><translation>Quecksilber g e</translation></message>
<message><source>method</source><translation>Methode</translation></message>
<message><source>method "{method}" describes no pupil; choose {methods}</source><translation>Verfahren "{method}" beschreibt keine Pupille; {methods} wählen</translation></message>
<message><source>method "{method}" is unknown; choose {methods}</source><translation>die Methode "{method}" ist unbekannt; {methods} wählen</translation></message>
<message><source>methods here</source><translation>Verfahren hier</translation></message>
<message><source>misaligned is not a list of tables; head every piece with [[misaligned]]</source><translation>misaligned ist keine Liste von Tabellen; jedes Stück mit [[misaligned]] überschreiben</translation></message>
<message><source>misses the sensor, which is curved or tilted</source><translation>verfehlt den Sensor, der gewölbt oder verkippt ist</translation></message>
<message><source>misses surface {surface}</source><translation>verfehlt Fläche {surface}</translation></message>
<message><source>mm</source><translation>mm</translation></message>
<message><source>mode {mode} is not sequential; export the sequential lens</source><translation>der Modus {mode} ist nicht sequentiell; das sequentielle Objektiv exportieren</translation></message>
<message><source>model</source><translation>Modell</translation></message>
<message><source>move the slider that has the focus</source><translation>den Regler bewegen, der den Fokus hat</translation></message>
<message><source>much fainter than the others</source><translation>viel schwächer als die anderen</translation></message>
<message><source>narrow the depths, the fields or the wavelengths</source><translation>Abstände, Felder oder Wellenlängen einengen</translation></message>
<message><source>nd is {value}; give an index between 1 and 4</source><translation>nd ist {value}; einen Index zwischen 1 und 4 angeben</translation></message>
<message><source>neural</source><translation>neuronal</translation></message>
<message><source>nm</source><translation>nm</translation></message>
<message><source>no</source><translation>keine</translation></message>
<message><source>no PSF of this lens is sharp enough for the atlas; stop down</source><translation>keine PSF dieses Objektivs ist scharf genug für den Atlas; abblenden</translation></message>
<message><source>no R² predicted</source><translation>kein R² vorhergesagt</translation></message>
<message><source>no aperture is stated; the narrowest rim, surface {number}, limits the light</source><translation>keine Öffnung ist angegeben; der engste Rand, Fläche {number}, begrenzt das Licht</translation></message>
<message><source>no chief ray of an object at {depth} lands {height:.4g} mm from the axis, where the sensor's corner is; take a smaller sensor</source><translation>kein Hauptstrahl eines Objekts bei {depth} landet {height:.4g} mm neben der Achse, wo die Ecke des Sensors ist; einen kleineren Sensor nehmen</translation></message>
<message><source>no chief ray of this lens's field reaches the sensor; choose a part of the field instead</source><translation>kein Hauptstrahl aus dem Feld dieses Objektivs erreicht den Sensor; stattdessen einen Teil des Feldes wählen</translation></message>
<message><source>no depth in front of the lens is sharp</source><translation>kein Abstand vor dem Objektiv ist scharf</translation></message>
<message><source>no display answers at DISPLAY={display}; start it from a desktop session, or under xvfb-run</source><translation>kein Bildschirm antwortet auf DISPLAY={display}; aus einer Desktop-Sitzung oder unter xvfb-run starten</translation></message>
<message><source>no fit has {numbers} numbers; choose one of {offered}</source><translation>keine Anpassung hat {numbers} Zahlen; eine von {offered} wählen</translation></message>
<message><source>no glass (NM and CD lines) is in this file; give an AGF catalogue</source><translation>in dieser Datei ist kein Glas (Zeilen NM und CD); einen AGF-Katalog angeben</translation></message>
<message><source>no nodes</source><translation>keine Knoten</translation></message>
<message><source>no numbers of the whole frame: what they leave is {chi2:.3g} times the variance of the noise, and {most:g} is the most. Check f-number, wavelength, pixel, distance, focus and stated noise, and that the picture is linear, not cropped, and of points much smaller than a pixel; or name what else may be wrong with the lens as unknowns</source><translation>keine Zahlen des ganzen Bildes: sie lassen das {chi2:.3g}-Fache der Varianz des Rauschens übrig, höchstens das {most:g}-Fache darf es sein. Prüfen Sie Blendenzahl, Wellenlänge, Pixel, Abstand, Fokus und das angegebene Rauschen, und ob das Bild linear, nicht beschnitten und von Punkten viel kleiner als ein Pixel ist; oder nennen Sie als Unbekannte, was am Objektiv sonst falsch sein kann</translation></message>
<message><source>no picture</source><translation>kein Bild</translation></message>
<message><source>no point can be used: {flags}; expose less, or move the points apart</source><translation>kein Punkt ist brauchbar: {flags}; kürzer belichten oder die Punkte weiter auseinanderrücken</translation></message>
<message><source>no point of the target</source><translation>kein Punkt der Zielkarte</translation></message>
<message><source>no point rises above the noise in a window of {shape} pixels; expose longer, or choose another point</source><translation>in einem Fenster von {shape} Pixeln hebt sich kein Punkt vom Rauschen ab; länger belichten oder einen anderen Punkt wählen</translation></message>
<message><source>no point rises above the noise of {noise:.3g} counts; expose longer, or check the dark field</source><translation>kein Punkt hebt sich vom Rauschen von {noise:.3g} Zählwerten ab; länger belichten oder das Dunkelbild prüfen</translation></message>
<message><source>no polynomial fits the rays of this pupil; stop the lens down or reduce the field</source><translation>kein Polynom folgt den Strahlen dieser Pupille; abblenden oder das Feld verkleinern</translation></message>
<message><source>no ray but the chief ray reaches the sensor; stop the lens down or reduce the field</source><translation>kein Strahl außer dem Hauptstrahl erreicht den Sensor; abblenden oder das Feld verkleinern</translation></message>
<message><source>no ray lands within {half} pixels of the chief ray; take larger pixels</source><translation>im Umkreis von {half} Pixeln um den Hauptstrahl landet kein Strahl; größere Pixel nehmen</translation></message>
<message><source>no ray of the fan reaches the sensor; choose a smaller field</source><translation>kein Strahl des Fächers erreicht den Sensor; ein kleineres Feld wählen</translation></message>
<message><source>no ray reaches the sensor; choose a smaller field or stop the lens down</source><translation>kein Strahl erreicht den Sensor; ein kleineres Feld wählen oder abblenden</translation></message>
<message><source>no ray reaches the sensor; {remedy}</source><translation>kein Strahl erreicht den Sensor; {remedy}</translation></message>
<message><source>no stop (AST) is stated; surface 1 is the stop, which is what OSLO takes</source><translation>es ist keine Blende (AST) angegeben; Fläche 1 ist die Blende, wie OSLO es annimmt</translation></message>
<message><source>no stop (STO) is stated; surface 1 is the stop, which is what CODE V takes</source><translation>keine Blende (STO) ist angegeben; Fläche 1 ist die Blende, wie CODE V es annimmt</translation></message>
<message><source>no stop is named; the narrowest rim, surface {number}, is the stop</source><translation>keine Blende ist genannt; der engste Rand, Fläche {number}, ist die Blende</translation></message>
<message><source>no stop named</source><translation>keine Blende genannt</translation></message>
<message><source>none</source><translation>keine</translation></message>
<message><source>normalisation radius</source><translation>Normierungsradius</translation></message>
<message><source>not converged: agrees to {reached:.1e} only</source><translation>nicht konvergiert: stimmt nur auf {reached:.1e} überein</translation></message>
<message><source>not symmetric: sections seen along x</source><translation>unsymmetrisch: Schnitte längs x gesehen</translation></message>
<message><source>not used because</source><translation>nicht verwendet, weil</translation></message>
<message><source>nothing</source><translation>nichts</translation></message>
<message><source>nothing in this lens can be wrong; give it a surface with power</source><translation>an diesem Objektiv kann nichts abweichen; ihm eine Fläche mit Brechkraft geben</translation></message>
<message><source>nothing is off</source><translation>alles stimmt</translation></message>
<message><source>nothing is pinned as B (Ctrl+B)</source><translation>nichts ist als B gemerkt (Strg+B)</translation></message>
<message><source>nothing varies from column to column; list the values of what does</source><translation>nichts ändert sich von Spalte zu Spalte; die Werte dessen auflisten, was sich ändert</translation></message>
<message><source>number of blades</source><translation>Zahl der Lamellen</translation></message>
<message><source>number of columns</source><translation>Anzahl der Spalten</translation></message>
<message><source>number of configurations</source><translation>Zahl der Konfigurationen</translation></message>
<message><source>number of extra data</source><translation>Nummer der Zusatzdaten</translation></message>
<message><source>number of rays drawn from a point</source><translation>Zahl der von einem Punkt gezeichneten Strahlen</translation></message>
<message><source>number of rows</source><translation>Anzahl der Zeilen</translation></message>
<message><source>number of the build</source><translation>Nummer des Exemplars</translation></message>
<message><source>number of the draw</source><translation>Nummer der Ziehung</translation></message>
<message><source>number of vanes</source><translation>Zahl der Streben</translation></message>
<message><source>number of wavelengths</source><translation>Anzahl der Wellenlängen</translation></message>
<message><source>numerical aperture {value:g} is impossible in index {index:g}; correct it</source><translation>die numerische Apertur {value:g} ist im Index {index:g} unmöglich; berichtigen</translation></message>
<message><source>object at infinity</source><translation>Objekt im Unendlichen</translation></message>
<message><source>object at {distance}</source><translation>Objekt bei {distance}</translation></message>
<message><source>object heights</source><translation>Objekthöhen</translation></message>
<message><source>object na</source><translation>objektseitige NA</translation></message>
<message><source>object space</source><translation>Objektraum</translation></message>
<message><source>object {h} mm</source><translation>Objekt {h} mm</translation></message>
<message><source>obscuration</source><translation>Abschattung</translation></message>
<message><source>odd asphere</source><translation>ungerade Asphäre</translation></message>
<message><source>odd asphere: coefficients of r, r², … in mm {numbers:.6g}</source><translation>ungerade Asphäre: Koeffizienten von r, r², … in mm {numbers:.6g}</translation></message>
<message><source>of light</source><translation>des Lichts</translation></message>
<message><source>of peak</source><translation>der Spitze</translation></message>
<message><source>off</source><translation>aus</translation></message>
<message><source>on</source><translation>an</translation></message>
<message><source>on screen: {method}, {ms} ms, {error}</source><translation>auf dem Bildschirm: {method}, {ms} ms, {error}</translation></message>
<message><source>on the pixels, µm</source><translation>auf den Pixeln, µm</translation></message>
<message><source>on top of the tilts of its file</source><translation>zusätzlich zu den Kippungen seiner Datei</translation></message>
<message><source>one focus does not determine the common sign of all even terms; add a second focus at a known distance</source><translation>ein Fokus lässt das gemeinsame Vorzeichen aller geraden Terme offen; ein zweiter, bekannter Fokus entscheidet</translation></message>
<message><source>one wavelength, no colour</source><translation>eine Wellenlänge, keine Farbe</translation></message>
<message><source>one-sided rings and a moved peak</source><translation>einseitige Ringe und eine verschobene Spitze</translation></message>
<message><source>only some columns of the lens have {name}; give it to all of them or to none</source><translation>nur manche Spalten des Objektivs haben {name}; allen oder keiner geben</translation></message>
<message><source>only {share:.0%} of the light lies in the window; take a larger one</source><translation>nur {share:.0%} des Lichts liegen im Fenster; ein größeres nehmen</translation></message>
<message><source>open it: Zemax .zmx (also zipped), CODE V .seq, OSLO .len, ray-optics .roa, .json of ISET, Optiland, DeepLens, ray-optics-web and of patents, .fx of renderers, ISET .dat, Optical Bench .txt, .csv with named columns, .toml, or a saved state</source><translation>öffnet sie: Zemax .zmx (auch gezippt), CODE V .seq, OSLO .len, ray-optics .roa, .json von ISET, Optiland, DeepLens, ray-optics-web und von Patenten, .fx von Renderern, ISET .dat, Optical Bench .txt, .csv mit benannten Spalten, .toml oder ein gespeicherter Zustand</translation></message>
<message><source>or</source><translation>oder</translation></message>
<message><source>order or wavelength of a phase</source><translation>Ordnung oder Wellenlänge einer Phase</translation></message>
<message><source>other wavefronts explain the pictures as well: {count}; add a focus</source><translation>andere Wellenfronten erklären die Bilder ebenso gut: {count}; einen Fokus hinzufügen</translation></message>
<message><source>outer radius</source><translation>Außenradius</translation></message>
<message><source>overlaps another point</source><translation>überlappt einen anderen Punkt</translation></message>
<message><source>parameter</source><translation>Parameter</translation></message>
<message><source>parameter number</source><translation>Parameternummer</translation></message>
<message><source>paraxial</source><translation>paraxial</translation></message>
<message><source>paraxial, axis</source><translation>paraxial, Achse</translation></message>
<message><source>partial dispersion</source><translation>Teildispersion</translation></message>
<message><source>parts of the lens are tilted or decentred, and its pupil is no paraxial disc; choose {parameter} stop</source><translation>Teile des Objektivs sind gekippt oder dezentriert, und seine Pupille ist keine paraxiale Scheibe; {parameter} stop wählen</translation></message>
<message><source>parts of the lens are tilted or decentred, which {what} cannot express; save as TOML, or for Zemax at one position</source><translation>Teile des Objektivs sind gekippt oder dezentriert, was {what} nicht sagen kann; als TOML speichern oder für Zemax in einer Stellung</translation></message>
<message><source>passes</source><translation>kommt durch</translation></message>
<message><source>peak</source><translation>Spitze</translation></message>
<message><source>peak = 1</source><translation>Spitze = 1</translation></message>
<message><source>peak, waves</source><translation>Spitze, Wellen</translation></message>
<message><source>pentafoil</source><translation>Fünfblattfehler</translation></message>
<message><source>per pixel</source><translation>je Pixel</translation></message>
<message><source>perfect lens</source><translation>ideale Linse</translation></message>
<message><source>perfect lens, µm</source><translation>ideale Linse, µm</translation></message>
<message><source>perfect, clear pupil</source><translation>ideal, freie Pupille</translation></message>
<message><source>perfect, same pupil</source><translation>ideal, dieselbe Pupille</translation></message>
<message><source>phase</source><translation>Phase</translation></message>
<message><source>photo</source><translation>Foto</translation></message>
<message><source>photo it took, sharpened</source><translation>sein Foto, geschärft</translation></message>
<message><source>picture encoding "{encoding}" is unknown; choose {choices}</source><translation>die Bildkodierung "{encoding}" ist unbekannt; {choices} wählen</translation></message>
<message><source>picture − reference, µm</source><translation>Bild − Referenz, µm</translation></message>
<message><source>pictures of {one} and {two}; compare two of one shape, at least {least} pixels a side</source><translation>Bilder von {one} und {two}; zwei von einer Form vergleichen, mit mindestens {least} Pixeln je Seite</translation></message>
<message><source>pictures {wide} µm wide</source><translation>Bilder {wide} µm breit</translation></message>
<message><source>pictures {wide} µm wide, each over its own peak</source><translation>Bilder {wide} µm breit, jedes über seiner Spitze</translation></message>
<message><source>pin a marker to a plot; lock its scales</source><translation>in einem Diagramm eine Marke setzen, seine Skalen festhalten</translation></message>
<message><source>pincushion {part} at {field}</source><translation>Kissen {part} bei {field}</translation></message>
<message><source>piston</source><translation>Kolbenterm</translation></message>
<message><source>pixel</source><translation>Pixel</translation></message>
<message><source>pixel of the measured picture</source><translation>Pixel des gemessenen Bildes</translation></message>
<message><source>pixel of the photo</source><translation>Pixel des Fotos</translation></message>
<message><source>pixels a side</source><translation>Pixel je Seite</translation></message>
<message><source>pixels of {pixel:g} µm average finer fringes; the window has a margin of {margin:.0%}</source><translation>Pixel von {pixel:g} µm mitteln feinere Streifen; das Fenster hat einen Rand von {margin:.0%}</translation></message>
<message><source>place in the entrance pupil, pupil radii</source><translation>Ort in der Eintrittspupille, Pupillenradien</translation></message>
<message><source>place in the stop, stop radii</source><translation>Ort in der Blende, Blendenradien</translation></message>
<message><source>places × depths × wavelengths: {places} × {depths} × {waves}; all others lie on polynomials through them</source><translation>Orte × Abstände × Wellenlängen: {places} × {depths} × {waves}; alle übrigen liegen auf Polynomen durch diese</translation></message>
<message><source>planned</source><translation>geplant</translation></message>
<message><source>planning</source><translation>Plan</translation></message>
<message><source>play is "{name}"; name a slider: {sliders}</source><translation>play ist "{name}"; einen Regler nennen: {sliders}</translation></message>
<message><source>points {depth} away blur over {size:.2g} mm, which takes {side}² samples of {most}² at most; bring the depths nearer to the focus or stop down</source><translation>Punkte in {depth} Entfernung verschwimmen über {size:.2g} mm, das braucht {side}² Proben von höchstens {most}²; die Abstände näher an den Fokus bringen oder abblenden</translation></message>
<message><source>position {number} of {count} lacks a distance; those before it are read</source><translation>Stellung {number} von {count} fehlt ein Abstand; die davor werden gelesen</translation></message>
<message><source>precision grade</source><translation>Klasse präzise</translation></message>
<message><source>predicted 1 − R² ≤ {error}</source><translation>vorhergesagt 1 − R² ≤ {error}</translation></message>
<message><source>predicted R² ≥ {r}</source><translation>vorhergesagt R² ≥ {r}</translation></message>
<message><source>present field</source><translation>jetziges Feld</translation></message>
<message><source>preview</source><translation>Vorschau</translation></message>
<message><source>preview {fast} / settled {ms} ms</source><translation>Vorschau {fast} / fertig {ms} ms</translation></message>
<message><source>preview {ms} ms</source><translation>Vorschau {ms} ms</translation></message>
<message><source>primary wavelength</source><translation>Hauptwellenlänge</translation></message>
<message><source>private glass {name} as a table of {count} indices, straight lines between them</source><translation>eigenes Glas {name} als Tabelle von {count} Indizes, dazwischen Geraden</translation></message>
<message><source>private glass {name} has no wavelengths (PWL) before it; add them</source><translation>dem privaten Glas {name} gehen keine Wellenlängen (PWL) voraus; hinzufügen</translation></message>
<message><source>private glass {name} has not one index per wavelength; complete it</source><translation>das private Glas {name} hat nicht einen Index je Wellenlänge; ergänzen</translation></message>
<message><source>private glass {name}: {error}</source><translation>privates Glas {name}: {error}</translation></message>
<message><source>pupil is {found}; write [pupil] and what stands in the stop</source><translation>pupil ist {found}; [pupil] schreiben und was in der Blende steht</translation></message>
<message><source>pupils</source><translation>Pupillen</translation></message>
<message><source>quality "{quality}" is unknown; choose "settled" or "preview"</source><translation>die Güte "{quality}" ist unbekannt; "settled" oder "preview" wählen</translation></message>
<message><source>quaternary astigmatism</source><translation>quartärer Astigmatismus</translation></message>
<message><source>quaternary coma</source><translation>quartäre Koma</translation></message>
<message><source>quaternary pentafoil</source><translation>quartärer Fünfblattfehler</translation></message>
<message><source>quaternary spherical aberration</source><translation>quartäre sphärische Aberration</translation></message>
<message><source>quaternary tetrafoil</source><translation>quartärer Vierblattfehler</translation></message>
<message><source>quaternary trefoil</source><translation>quartärer Dreiblattfehler</translation></message>
<message><source>radius</source><translation>Radius</translation></message>
<message><source>radius {number}: {radius} mm</source><translation>Radius {number}: {radius} mm</translation></message>
<message><source>radius, surface {where}</source><translation>Radius, Fläche {where}</translation></message>
<message><source>radius, µm</source><translation>Radius, µm</translation></message>
<message><source>rail_shares is {value}; give a list of numbers</source><translation>rail_shares ist {value}; geben Sie eine Liste von Zahlen an</translation></message>
<message><source>range_um of {name} is {limits}; write the shortest and the longest wavelength</source><translation>range_um von {name} ist {limits}; die kürzeste und die längste Wellenlänge schreiben</translation></message>
<message><source>ray</source><translation>Strahl</translation></message>
<message><source>ray density</source><translation>Strahlendichte</translation></message>
<message><source>rays are lost {where}, and neither six coefficients nor fits describe that; {remedy}</source><translation>{where} gehen Strahlen verloren, was weder sechs Koeffizienten noch Anpassungen beschreiben; {remedy}</translation></message>
<message><source>rays fill the paraxial entrance pupil</source><translation>Strahlen füllen die paraxiale Eintrittspupille</translation></message>
<message><source>rays fill the real stop</source><translation>Strahlen füllen die wirkliche Blende</translation></message>
<message><source>rays meet surface {surface} before surface {before}, beyond the edge of the glass, which is impossible; choose a smaller field or aperture</source><translation>Strahlen treffen Fläche {surface} vor Fläche {before}, jenseits des Glasrandes, wo kein Licht hingelangt; kleineres Feld oder kleinere Öffnung wählen</translation></message>
<message><source>rays of different parts of the pupil arrive in one direction, and the sum of their light has no limit; stop the lens down or reduce the field</source><translation>Strahlen aus verschiedenen Teilen der Pupille kommen in einer Richtung an, und die Summe ihres Lichts hat keine Grenze; abblenden oder das Feld verkleinern</translation></message>
<message><source>rays within a radius of {radius:g} are lost, a hole or an obscuration, where rims clip</source><translation>Strahlen innerhalb eines Radius von {radius:g} gehen verloren, ein Loch oder eine Abschattung, wo Fassungen abschneiden</translation></message>
<message><source>read</source><translation>gelesen</translation></message>
<message><source>reads another file, which was not found</source><translation>liest eine andere Datei, die nicht vorliegt</translation></message>
<message><source>rear group</source><translation>hintere Gruppe</translation></message>
<message><source>red</source><translation>Rot</translation></message>
<message><source>reference from {count} rays, {seconds} s</source><translation>Referenz aus {count} Strahlen, {seconds} s</translation></message>
<message><source>reference wavelength</source><translation>Referenzwellenlänge</translation></message>
<message><source>reference, µm</source><translation>Referenz, µm</translation></message>
<message><source>refractive index</source><translation>Brechzahl</translation></message>
<message><source>refractive index is {value}; give a number between 0.5 and 6</source><translation>der Brechungsindex ist {value}; eine Zahl zwischen 0,5 und 6 angeben</translation></message>
<message><source>refused</source><translation>abgelehnt</translation></message>
<message><source>relative L2 error</source><translation>relativer L2-Fehler</translation></message>
<message><source>relative error of R80</source><translation>relativer Fehler von R80</translation></message>
<message><source>no surface states a transmission, and the absorption of the glasses is off</source><translation>keine Fläche nennt eine Durchlässigkeit, und die Absorption der Gläser ist aus</translation></message>
<message><source>transmission of colours</source><translation>Durchlässigkeit der Farben</translation></message>
<message><source>transmission over the field</source><translation>Durchlässigkeit über dem Feld</translation></message>
<message><source>transmission, %</source><translation>Durchlässigkeit, %</translation></message>
<message><source>relative illumination</source><translation>relative Beleuchtungsstärke</translation></message>
<message><source>relative illumination, %</source><translation>relative Beleuchtungsstärke, %</translation></message>
<message><source>rim</source><translation>Rand</translation></message>
<message><source>rim offset</source><translation>Versatz des Rands</translation></message>
<message><source>rim rays</source><translation>Randstrahlen, Feld</translation></message>
<message><source>rim rays of the field point</source><translation>Randstrahlen des Feldpunkts</translation></message>
<message><source>rims clip</source><translation>mit Rändern</translation></message>
<message><source>rims and the mask in the stop leave nothing open; leave {parameter} off</source><translation>Ränder und die Maske in der Blende lassen nichts offen; {parameter} weglassen</translation></message>
<message><source>root of brightness</source><translation>Wurzel der Helligkeit</translation></message>
<message><source>roundness</source><translation>Rundung</translation></message>
<message><source>sagittal</source><translation>sagittal</translation></message>
<message><source>sagittal S</source><translation>sagittal S</translation></message>
<message><source>sagittal S, third order</source><translation>sagittal S, dritte Ordnung</translation></message>
<message><source>sagittal, along ξ</source><translation>sagittal, längs ξ</translation></message>
<message><source>sampling</source><translation>Abtastung</translation></message>
<message><source>sampling "{sampling}" is unknown; choose "mdft" or "fft"</source><translation>die Abtastung "{sampling}" ist unbekannt; "mdft" oder "fft" wählen</translation></message>
<message><source>saturated</source><translation>gesättigt</translation></message>
<message><source>scene</source><translation>Szene</translation></message>
<message><source>secondary astigmatism</source><translation>sekundärer Astigmatismus</translation></message>
<message><source>secondary coma</source><translation>sekundäre Koma</translation></message>
<message><source>secondary pentafoil</source><translation>sekundärer Fünfblattfehler</translation></message>
<message><source>secondary spherical aberration</source><translation>sekundäre sphärische Aberration</translation></message>
<message><source>secondary tetrafoil</source><translation>sekundärer Vierblattfehler</translation></message>
<message><source>secondary trefoil</source><translation>sekundärer Dreiblattfehler</translation></message>
<message><source>seconds one way</source><translation>Sekunden je Weg</translation></message>
<message><source>seidel</source><translation>seidel</translation></message>
<message><source>seidel from the six coefficients (what-if: coefficients altered by hand)</source><translation>seidel aus den sechs Koeffizienten (Was wäre wenn: von Hand geändert)</translation></message>
<message><source>gaussian: fitted to the reference</source><translation>gaussian: an die Referenz angepasst</translation></message>
<message><source>seidel: six coefficients</source><translation>seidel: sechs Koeffizienten</translation></message>
<message><source>semi-diameter</source><translation>Halbmesser</translation></message>
<message><source>semicolons</source><translation>Semikolons</translation></message>
<message><source>sensor</source><translation>Sensor</translation></message>
<message><source>sensor at {place} mm, shift {shift}</source><translation>Sensor bei {place} mm, Verschiebung {shift}</translation></message>
<message><source>sensor centre_mm is ({centre}); give two finite numbers</source><translation>centre_mm des Sensors ist ({centre}); zwei endliche Zahlen angeben</translation></message>
<message><source>sensor pixel_um is {pitch:g} µm; give a positive pitch below 0.1 m</source><translation>pixel_um des Sensors ist {pitch:g} µm; einen positiven Pixelabstand unter 0,1 m angeben</translation></message>
<message><source>sensor shift</source><translation>Sensorversatz</translation></message>
<message><source>sensor shift {shift} µm: share of the perfect peak</source><translation>Sensorversatz {shift} µm: Anteil der perfekten Spitze</translation></message>
<message><source>sensor shift, µm</source><translation>Sensorversatz, µm</translation></message>
<message><source>sensor stays</source><translation>Sensor bleibt</translation></message>
<message><source>sensor {key} is {value:g}; give a whole number</source><translation>{key} des Sensors ist {value:g}; eine ganze Zahl angeben</translation></message>
<message><source>settled {ms} ms</source><translation>fertig {ms} ms</translation></message>
<message><source>share of a panel beside the stage</source><translation>Anteil einer Ansicht neben der Bühne</translation></message>
<message><source>share of the light, 1/µm²</source><translation>Anteil des Lichts, 1/µm²</translation></message>
<message><source>share of the light in a pixel</source><translation>Anteil des Lichts in einem Pixel</translation></message>
<message><source>share of the peak</source><translation>Anteil an der Spitze</translation></message>
<message><source>share of the stage</source><translation>Anteil der Bühne</translation></message>
<message><source>sharp from {near} to {far} · hyperfocal distance {focus}</source><translation>scharf von {near} bis {far} · hyperfokal {focus}</translation></message>
<message><source>sharpened</source><translation>geschärft</translation></message>
<message><source>sharpened by its PSFs</source><translation>mit seinen PSFs geschärft</translation></message>
<message><source>sharpened wrongly</source><translation>falsch geschärft</translation></message>
<message><source>shift of the image</source><translation>Verschiebung des Bildes</translation></message>
<message><source>shift of the image, µm</source><translation>Verschiebung des Bildes, µm</translation></message>
<message><source>shift ≤ {limit} µm</source><translation>Verschiebung ≤ {limit} µm</translation></message>
<message><source>shift, µm</source><translation>Verschiebung, µm</translation></message>
<message><source>shifts, µm</source><translation>Versatz, µm</translation></message>
<message><source>shown is "{side}" and nothing is pinned as B; pin a state first (Ctrl+B)</source><translation>gezeigt wird "{side}", und nichts ist als B gemerkt; zuerst einen Zustand merken (Strg+B)</translation></message>
<message><source>side by side</source><translation>nebeneinander</translation></message>
<message><source>sides of the photo cut off</source><translation>Foto seitlich abgeschnitten</translation></message>
<message><source>six coefficients</source><translation>sechs Koeffizienten</translation></message>
<message><source>six coefficients keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed</source><translation>sechs Koeffizienten halten 1 − R² ≤ {error:.1e} ein, erlaubt ist {allowed:.1e}</translation></message>
<message><source>size of type</source><translation>Schriftgröße</translation></message>
<message><source>source depth</source><translation>Objektabstand</translation></message>
<message><source>spatial frequency</source><translation>Ortsfrequenz</translation></message>
<message><source>spectral lines have no power per wavelength; take their wavelengths one by one</source><translation>Spektrallinien haben keine Leistung je Wellenlänge; ihre Wellenlängen einzeln nehmen</translation></message>
<message><source>spectrum</source><translation>Spektrum</translation></message>
<message><source>spherical</source><translation>sphärisch</translation></message>
<message><source>spherical aberration</source><translation>sphärische Aberration</translation></message>
<message><source>spherical: waves from the exit pupil</source><translation>spherical: Wellen aus der Austrittspupille</translation></message>
<message><source>split</source><translation>geteilt</translation></message>
<message><source>split of the photo</source><translation>Teilung des Fotos</translation></message>
<message><source>square root</source><translation>Wurzel</translation></message>
<message><source>step of the lesson</source><translation>Schritt der Lektion</translation></message>
<message><source>step {k} of {n}</source><translation>Schritt {k} von {n}</translation></message>
<message><source>stop</source><translation>Blende</translation></message>
<message><source>stop "{mode}" is unknown; choose "file" or "auto"</source><translation>die Blende "{mode}" ist unbekannt; "file" oder "auto" wählen</translation></message>
<message><source>stop down</source><translation>abblenden</translation></message>
<message><source>stop down or go nearer the axis to see waves</source><translation>abblenden oder näher an die Achse gehen, um Wellen zu sehen</translation></message>
<message><source>stop down to see waves</source><translation>abblenden, um Wellen zu sehen</translation></message>
<message><source>stop down, or leave clipping off</source><translation>abblenden oder den Randbeschnitt auslassen</translation></message>
<message><source>stop on surface {number}</source><translation>Blende auf Fläche {number}</translation></message>
<message><source>stop semi diameter</source><translation>Halbmesser der Blende</translation></message>
<message><source>stop semi diameter {value:.6g} mm</source><translation>Halbmesser der Blende {value:.6g} mm</translation></message>
<message><source>stop surface</source><translation>Fläche der Blende</translation></message>
<message><source>stop surface {stop} does not exist; the lens has surfaces 1 to {count}</source><translation>die Blendenfläche {stop} gibt es nicht; das Objektiv hat die Flächen 1 bis {count}</translation></message>
<message><source>stop {gap} mm behind surface {number}</source><translation>Blende {gap} mm hinter Fläche {number}</translation></message>
<message><source>stop ▪</source><translation>Blende ▪</translation></message>
<message><source>stop_surface is {number}; write a surface from 1 to {count}</source><translation>stop_surface ist {number}; eine Fläche von 1 bis {count} schreiben</translation></message>
<message><source>stopped; choose the picture again to measure it</source><translation>angehalten; das Bild neu wählen, um es zu messen</translation></message>
<message><source>stops</source><translation>Blenden</translation></message>
<message><source>substituted</source><translation>ersetzt</translation></message>
<message><source>sum</source><translation>Summe</translation></message>
<message><source>sum = 1</source><translation>Summe = 1</translation></message>
<message><source>sum {sum} λ</source><translation>Summe {sum} λ</translation></message>
<message><source>summing the reference: {part} %</source><translation>die Referenz wird summiert: {part} %</translation></message>
<message><source>surface</source><translation>Fläche</translation></message>
<message><source>surface is not a list of tables; head every surface with [[surface]]</source><translation>surface ist keine Liste von Tabellen; jede Fläche mit [[surface]] überschreiben</translation></message>
<message><source>surface number</source><translation>Flächennummer</translation></message>
<message><source>surface or number</source><translation>Fläche oder Nummer</translation></message>
<message><source>surface {number}</source><translation>Fläche {number}</translation></message>
<message><source>surface {number} (auto)</source><translation>Fläche {number} (gefunden)</translation></message>
<message><source>surface {number} (file)</source><translation>Fläche {number} (Datei)</translation></message>
<message><source>surface {number} has no rim to be the stop; give it a semi-diameter first</source><translation>Fläche {number} hat keinen Rand, der Blende sein könnte; ihr zuerst einen Halbmesser geben</translation></message>
<message><source>surface {number} is the stop; put the stop on another surface before deleting it</source><translation>Fläche {number} ist die Blende; die Blende auf eine andere Fläche legen, bevor diese gelöscht wird</translation></message>
<message><source>surface {number} is where {due} is expected</source><translation>Fläche {number} steht, wo {due} kommen müsste</translation></message>
<message><source>surface {number} is where {due} is expected; sort them</source><translation>Fläche {number} steht, wo {due} kommen müsste; ordnen</translation></message>
<message><source>surface {surface}</source><translation>Fläche {surface}</translation></message>
<message><source>surface {surface} ({label})</source><translation>Fläche {surface} ({label})</translation></message>
<message><source>surface {surface} diffracts and has terms other than even ones up to r^16, for which Zemax has no line; save as TOML</source><translation>Fläche {surface} beugt und hat andere Glieder als gerade bis r^16, für die Zemax keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} has a clear semi-diameter of {rim:g} mm, beyond the normalisation radius of {radius:g} mm up to which its polynomials describe it; correct one of the two</source><translation>Fläche {surface} hat einen freien Halbmesser von {rim:g} mm, jenseits des Normierungsradius von {radius:g} mm, bis zu dem ihre Polynome sie beschreiben; eines von beiden berichtigen</translation></message>
<message><source>surface {surface} has a clear semi-diameter of {rim:g} mm, but with its radius of {radius:g} mm it ends at {edge:.6g} mm; correct one of the two</source><translation>Fläche {surface} hat einen freien Halbmesser von {rim:g} mm, aber ihr Radius von {radius:g} mm lässt sie bei {edge:.6g} mm enden; eines von beiden berichtigen</translation></message>
<message><source>surface {surface} has a rectangular rim that is turned or has a hole, for which Zemax has no line; save as TOML</source><translation>Fläche {surface} hat einen rechteckigen Rand, der gedreht ist oder ein Loch hat, wofür Zemax keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} has a term in r^{power}, and a CODE V file holds powers up to r^{most}; save as TOML</source><translation>Fläche {surface} hat ein Glied in r^{power}, und eine CODE-V-Datei fasst Potenzen bis r^{most}; als TOML speichern</translation></message>
<message><source>surface {surface} is a mirror, which has no refractive index</source><translation>Fläche {surface} ist ein Spiegel, der keine Brechzahl hat, die falsch sein könnte</translation></message>
<message><source>surface {surface} is an ideal lens of focal length {focal:g} mm; it must be a plane without diffraction, and its focal length must not be 0</source><translation>Fläche {surface} ist eine ideale Linse der Brennweite {focal:g} mm; sie muss eben sein und darf nicht beugen, und die Brennweite darf nicht 0 sein</translation></message>
<message><source>surface {surface} is no conic with even terms from r⁴ on, which a file for {program} cannot express; save as TOML</source><translation>Fläche {surface} ist kein Kegelschnitt mit geraden Gliedern ab r⁴, was eine Datei für {program} nicht sagen kann; als TOML speichern</translation></message>
<message><source>surface {surface} is not an object with radius and thickness; correct it</source><translation>Fläche {surface} ist kein Objekt mit radius und thickness; berichtigen</translation></message>
<message><source>surface {surface} is tilted or decentred (transform); only centred lenses are read</source><translation>Fläche {surface} ist gekippt oder dezentriert (transform); nur zentrierte Objektive werden gelesen</translation></message>
<message><source>surface {surface}, line {line}: {message}</source><translation>Fläche {surface}, Zeile {line}: {message}</translation></message>
<message><source>surface {surface}: no lens file can express {what}; leave it out</source><translation>Fläche {surface}: {what} lässt sich in keiner Linsendatei ausdrücken; weglassen</translation></message>
<message><source>surface {surface}: a number of its shape, its phase or its irregularity is not finite; correct it</source><translation>Fläche {surface}: eine Zahl ihrer Form, ihrer Phase oder ihres Passfehlers ist nicht endlich; berichtigen</translation></message>
<message><source>surface {surface}: a term in r^{power} beside another shape; put all terms into one</source><translation>Fläche {surface}: ein Glied in r^{power} neben einer anderen Form; alle Glieder in eine setzen</translation></message>
<message><source>surface {surface}: a thickness of {thickness:g} mm that is off by {by:g} mm changes its sign; give a smaller error</source><translation>Fläche {surface}: eine Dicke von {thickness:g} mm, die um {by:g} mm falsch ist, wechselt ihr Vorzeichen; einen kleineren Fehler angeben</translation></message>
<message><source>surface {surface}: a tilt of {tilt:g}° about {axis} turns it edge-on or further; give less than 90°</source><translation>Fläche {surface}: eine Kippung von {tilt:g}° um {axis} stellt sie auf die Kante oder weiter; weniger als 90° angeben</translation></message>
<message><source>surface {surface}: a tilt or decentre is not finite; give finite numbers</source><translation>Fläche {surface}: eine Kippung oder Dezentrierung ist nicht endlich; endliche Zahlen angeben</translation></message>
<message><source>surface {surface}: aspheric term r^{power}; powers from 1 to {most} are read</source><translation>Fläche {surface}: asphärisches Glied r^{power}; Potenzen von 1 bis {most} werden gelesen</translation></message>
<message><source>surface {surface}: aspheric_coefficients is not a list of up to 20 numbers; correct it</source><translation>Fläche {surface}: aspheric_coefficients ist keine Liste von bis zu 20 Zahlen; berichtigen</translation></message>
<message><source>surface {surface}: conic or aspheric coefficient is not finite; correct it</source><translation>Fläche {surface}: der Kegelschnitt oder ein asphärischer Koeffizient ist nicht endlich; berichtigen</translation></message>
<message><source>surface {surface}: inner radius {inner} mm; give a number from 0 to below the semi-diameter</source><translation>Fläche {surface}: innerer Radius {inner} mm; eine Zahl von 0 bis unter den halben Durchmesser angeben</translation></message>
<message><source>surface {surface}: ior is neither a number nor [[nm …], [n …]]; correct it</source><translation>Fläche {surface}: ior ist weder eine Zahl noch [[nm …], [n …]]; berichtigen</translation></message>
<message><source>surface {surface}: ior is not a table of wavelengths and indices ({reason})</source><translation>Fläche {surface}: ior ist keine Tabelle von Wellenlängen und Indizes ({reason})</translation></message>
<message><source>surface {surface}: its rim has the centre ({centre:g}) mm and the half-widths {widths}; give finite numbers, and positive widths</source><translation>Fläche {surface}: ihr Rand hat die Mitte ({centre:g}) mm und die halben Breiten {widths}; endliche Zahlen und positive Breiten angeben</translation></message>
<message><source>surface {surface}: medium {medium}; give one of p2sf.glass.media, such as ConstantIndex(1.5)</source><translation>Fläche {surface}: Medium {medium}; geben Sie eines aus p2sf.glass.media an, etwa ConstantIndex(1.5)</translation></message>
<message><source>surface {surface}: normalisation radius {radius} mm; give a number from {low:g} to {high:g}</source><translation>Fläche {surface}: Normierungsradius {radius} mm; eine Zahl von {low:g} bis {high:g} angeben</translation></message>
<message><source>surface {surface}: radius {radius} mm; write inf for a plane</source><translation>Fläche {surface}: Radius {radius} mm; inf für eine Ebene schreiben</translation></message>
<message><source>surface {surface}: semi-diameter {semi_diameter} mm; give a positive number</source><translation>Fläche {surface}: Halbmesser {semi_diameter} mm; eine positive Zahl angeben</translation></message>
<message><source>surface {surface}: {message}</source><translation>Fläche {surface}: {message}</translation></message>
<message><source>surface {surface}: {name} differs between x and y; only round lenses are read</source><translation>Fläche {surface}: {name} unterscheidet sich zwischen x und y; nur runde Objektive werden gelesen</translation></message>
<message><source>surface {surface}: {name} is {found}; write a number</source><translation>Fläche {surface}: {name} ist {found}; eine Zahl schreiben</translation></message>
<message><source>surface {surface}: {what} differs between columns and is taken from the nearest, {near}</source><translation>Fläche {surface}: {what} ist nicht in allen Spalten gleich; maßgebend ist die nächste, {near}</translation></message>
<message><source>surfaces in the order of the light</source><translation>Flächen in der Reihenfolge des Lichts</translation></message>
<message><source>surfaces is {found}; write the first and the last, as in [3, 4]</source><translation>surfaces ist {found}; die erste und die letzte schreiben, wie in [3, 4]</translation></message>
<message><source>surfaces {first} and {last} are equally curved, so the element has no shape factor; change a radius first</source><translation>Die Flächen {first} und {last} sind gleich gekrümmt, daher hat das Element keinen Formfaktor; ändern Sie zuerst einen Radius</translation></message>
<message><source>surfaces {first} and {second} both are stops; keep one</source><translation>die Flächen {first} und {second} sind beide Blenden; eine behalten</translation></message>
<message><source>surfaces {first} and {second} both are the stop; keep one</source><translation>die Flächen {first} und {second} sind beide die Blende; eine behalten</translation></message>
<message><source>surfaces {first} to {last}</source><translation>Flächen {first} bis {last}</translation></message>
<message><source>surfaces {first} to {last} are not an element with air on both sides; choose such an element</source><translation>Die Flächen {first} bis {last} sind kein Element mit Luft auf beiden Seiten; wählen Sie ein frei stehendes</translation></message>
<message><source>surfaces {first} to {last} do not exist; the lens has surfaces 1 to {count}</source><translation>Flächen {first} bis {last} gibt es nicht; das Objektiv hat die Flächen 1 bis {count}</translation></message>
<message><source>surfaces {first} to {last}, n = {index}</source><translation>Flächen {first} bis {last}, n = {index}</translation></message>
<message><source>surround "{surround}" is unknown; choose {choices}</source><translation>das Umfeld "{surround}" ist unbekannt; {choices} wählen</translation></message>
<message><source>table 1 of the paper</source><translation>Tabelle 1 des Aufsatzes</translation></message>
<message><source>table1 {error} λ</source><translation>Tabelle 1 {error} λ</translation></message>
<message><source>taken differently from the file</source><translation>anders genommen als in der Datei</translation></message>
<message><source>takes</source><translation>nimmt</translation></message>
<message><source>tangential</source><translation>tangential</translation></message>
<message><source>tangential T</source><translation>tangential T</translation></message>
<message><source>tangential T, third order</source><translation>tangential T, dritte Ordnung</translation></message>
<message><source>tangential, along η</source><translation>tangential, längs η</translation></message>
<message><source>telecentric flag</source><translation>Kennzeichen der Telezentrie</translation></message>
<message><source>term</source><translation>Term</translation></message>
<message><source>term {number}</source><translation>Term {number}</translation></message>
<message><source>terms</source><translation>Terme</translation></message>
<message><source>tertiary astigmatism</source><translation>tertiärer Astigmatismus</translation></message>
<message><source>tertiary coma</source><translation>tertiäre Koma</translation></message>
<message><source>tertiary pentafoil</source><translation>tertiärer Fünfblattfehler</translation></message>
<message><source>tertiary spherical aberration</source><translation>tertiäre sphärische Aberration</translation></message>
<message><source>tertiary tetrafoil</source><translation>tertiärer Vierblattfehler</translation></message>
<message><source>tertiary trefoil</source><translation>tertiärer Dreiblattfehler</translation></message>
<message><source>tetrafoil</source><translation>Vierblattfehler</translation></message>
<message><source>the Airy pattern</source><translation>die Airy-Figur</translation></message>
<message><source>the PSF</source><translation>die PSF</translation></message>
<message><source>the added waves are {waves}; give {count} numbers, for {terms}</source><translation>die hinzugefügten Wellen sind {waves}; {count} Zahlen angeben, für {terms}</translation></message>
<message><source>the amplitude has the shape {shape} and the wavefront {wavefront}; give both on the same cells</source><translation>die Amplitude hat die Form {shape} und die Wellenfront {wavefront}; beide auf denselben Zellen angeben</translation></message>
<message><source>the amplitude is not finite, negative, or 0 everywhere; give one that lets light through</source><translation>die Amplitude ist nicht endlich, negativ oder überall 0; eine angeben, die Licht durchlässt</translation></message>
<message><source>the aperture ({kind} {value:g}) fills the stop to {rim:g} mm; correct it</source><translation>die Öffnung ({kind} {value:g}) füllt die Blende bis {rim:g} mm; berichtigen</translation></message>
<message><source>the aperture is {value:g}; give a positive number</source><translation>die Öffnung ist {value:g}; eine positive Zahl angeben</translation></message>
<message><source>the archive cannot be unpacked ({reason}); unpack it yourself</source><translation>das Archiv lässt sich nicht auspacken ({reason}); von Hand auspacken</translation></message>
<message><source>the archive contains no .zmx or .seq file; unpack the lens yourself</source><translation>das Archiv enthält keine .zmx- oder .seq-Datei; das Objektiv von Hand auspacken</translation></message>
<message><source>the aspheres have odd powers (AsphericalOddCount); only even ones are read</source><translation>die Asphären haben ungerade Potenzen (AsphericalOddCount); nur gerade werden gelesen</translation></message>
<message><source>the axis is folded, so glass cannot be moved by hand here; use the sliders of Misalign</source><translation>die Achse ist gefaltet, und Glas lässt sich hier nicht mit der Hand bewegen; die Regler von Dejustieren nehmen</translation></message>
<message><source>the black body has {given:g} K; give one temperature from {least:g} to {most:g} K, as in planck:5600</source><translation>der Schwarze Körper hat {given:g} K; eine Temperatur von {least:g} bis {most:g} K angeben, wie in planck:5600</translation></message>
<message><source>the blur is too large for a reference here; {remedy}</source><translation>die Unschärfe ist hier zu groß für eine Referenz; {remedy}</translation></message>
<message><source>the builds were cancelled before they were finished</source><translation>die Exemplare wurden angehalten, bevor sie fertig waren</translation></message>
<message><source>the chief ray {outcome}; choose a smaller field</source><translation>der Hauptstrahl {outcome}; ein kleineres Feld wählen</translation></message>
<message><source>the chief ray {outcome}; surface {placed} is decentred by ({decentre:g}) mm and tilted by ({tilt:g})°: make that or the field smaller</source><translation>der Hauptstrahl {outcome}; Fläche {placed} ist um ({decentre:g}) mm dezentriert und um ({tilt:g})° gekippt: das oder das Feld verkleinern</translation></message>
<message><source>the clear part of the pupil has no clear centre; leave {parameter} off or reduce the field</source><translation>der freie Teil der Pupille hat keine freie Mitte; {parameter} auslassen oder das Feld verkleinern</translation></message>
<message><source>the coefficients</source><translation>die Koeffizienten</translation></message>
<message><source>the columns have different numbers of fields or wavelengths, but a Zemax file has one; save as TOML</source><translation>die Spalten des Objektivs haben verschieden viele Felder oder Wellenlängen, eine Zemax-Datei hat eine Zahl; als TOML speichern</translation></message>
<message><source>the columns have {counts} surfaces; give every column the same surfaces</source><translation>die Spalten haben {counts} Flächen; jeder Spalte dieselben Flächen geben</translation></message>
<message><source>the columns of the lens have different {what}, {stated}; a file holds one, so give all the same</source><translation>die Spalten des Objektivs haben verschiedene {what}, {stated}; eine Datei hat nur eine, allen dieselbe geben</translation></message>
<message><source>the comet: rays fill a cone of 60°</source><translation>der Komet: Strahlen füllen einen Kegel von 60°</translation></message>
<message><source>the contrast at {frequency:g} cycles per mm is too small to be summed, at {field:.4g}°; choose a lower one</source><translation>der Kontrast bei {frequency:g} Perioden je mm ist zu klein, um summiert zu werden, bei {field:.4g}°; weniger wählen</translation></message>
<message><source>the dark or flat field has shape {shape} and the picture {wanted}; take both with the same sensor</source><translation>das Dunkel- oder Hellbild hat die Form {shape} und das Bild {wanted}; beide mit demselben Sensor aufnehmen</translation></message>
<message><source>the database maps were stopped</source><translation>die Datenbankkarten wurden angehalten</translation></message>
<message><source>the depth map has the shape ({shape}), but the picture ({picture}); resize it</source><translation>die Tiefenkarte hat die Form ({shape}), aber das Bild ({picture}); ihre Größe anpassen</translation></message>
<message><source>the depth map reaches from {low:g} mm to {high:g} mm, and the scene from {near:g} mm to {far:g} mm; give depths in mm from the first vertex, and the scene a range that holds them</source><translation>die Tiefenkarte reicht von {low:g} mm bis {high:g} mm, die Szene von {near:g} mm bis {far:g} mm; geben Sie Tiefen in mm ab dem ersten Scheitel an und der Szene einen Bereich, der sie enthält</translation></message>
<message><source>the distance "{text}" has an unknown unit; write mm, cm, m or km, or ∞</source><translation>der Abstand "{text}" hat eine unbekannte Einheit; mm, cm, m, km oder ∞ schreiben</translation></message>
<message><source>the energy follows when the slider rests</source><translation>die Energie folgt, wenn der Regler ruht</translation></message>
<message><source>the entrance pupil is at infinity, so a field angle has no meaning; move the stop away from that focus</source><translation>die Eintrittspupille liegt im Unendlichen, also sagt ein Feldwinkel nichts; die Blende von diesem Brennpunkt wegrücken</translation></message>
<message><source>the entrance pupil is at infinity, so a field angle has no meaning; move the stop away from that focus, or in Python state the field as an object height, field="height"</source><translation>die Eintrittspupille liegt im Unendlichen, also sagt ein Feldwinkel nichts; die Blende von diesem Brennpunkt wegrücken oder in Python das Feld als Objekthöhe angeben, field="height"</translation></message>
<message><source>the entrance pupil is at infinity, so it has no diameter; state the stop's semi-diameter</source><translation>die Eintrittspupille liegt im Unendlichen, hat also keinen Durchmesser; den Halbmesser der Blende angeben</translation></message>
<message><source>the entrance pupil, {pupil:.6g} mm before the first vertex, lies among the depths, {near:g} to {far:g} mm; build one database on either side of it</source><translation>die Eintrittspupille, {pupil:.6g} mm vor dem ersten Scheitel, liegt zwischen den Abständen, {near:g} bis {far:g} mm; auf jeder Seite von ihr eine Datenbank bauen</translation></message>
<message><source>the environment variable {name} is {value}; give a whole number of 1 or more</source><translation>die Umgebungsvariable {name} ist {value}; eine ganze Zahl ab 1 angeben</translation></message>
<message><source>the export was cancelled; nothing was written</source><translation>der Export wurde abgebrochen; nichts wurde geschrieben</translation></message>
<message><source>the field is stated {count} times, by {names}; keep one</source><translation>das Feld ist {count}-mal angegeben, durch {names}; eines behalten</translation></message>
<message><source>the field of {field:.4g}° lies beyond the {widest:g}° of this lens, where there is no picture of it; choose a smaller field, or the whole field</source><translation>das Feld von {field:.4g}° liegt außerhalb der {widest:g}° dieses Objektivs, wo es kein Bild davon gibt; ein kleineres Feld oder das ganze Feld wählen</translation></message>
<message><source>the field point lands {height:.4g} mm from the axis, and the photo ends at {half:.4g} mm; choose a smaller field, or every pixel of the photo</source><translation>der Feldpunkt liegt {height:.4g} mm von der Achse, und das Foto endet bei {half:.4g} mm; ein kleineres Feld oder jedes Pixel des Fotos wählen</translation></message>
<message><source>the fields of tolerances have several wavelengths; give them one</source><translation>die Felder von Toleranzen haben mehrere Wellenlängen; ihnen eine geben</translation></message>
<message><source>the file cannot be read ({reason}); check its path and permissions</source><translation>die Datei ist nicht lesbar ({reason}); Pfad und Rechte prüfen</translation></message>
<message><source>the file cannot be written ({reason}); choose another place</source><translation>die Datei ist nicht schreibbar ({reason}); einen anderen Ort wählen</translation></message>
<message><source>the file contains no lens surface between object and image</source><translation>die Datei enthält keine Linsenfläche zwischen Objekt und Bild</translation></message>
<message><source>the file contains no list of surfaces; {remedy}</source><translation>die Datei enthält keine Liste von Flächen; {remedy}</translation></message>
<message><source>the file contains no surface (S) between object and image</source><translation>die Datei enthält keine Fläche (S) zwischen Objekt und Bild</translation></message>
<message><source>the file contains no surface between object and image</source><translation>die Datei enthält keine Fläche zwischen Objekt und Bild</translation></message>
<message><source>the file does not say RDM; its numbers are read as radii, since {value:g} cannot be a lens's curvature</source><translation>die Datei sagt kein RDM; ihre Zahlen sind als Radien gelesen, denn {value:g} ist keine Krümmung einer Linse</translation></message>
<message><source>the file does not say where the sensor is, and the lens has no focus; it is at the last vertex</source><translation>die Datei sagt nicht, wo der Sensor steht, und das Objektiv hat keinen Fokus; er steht am letzten Scheitel</translation></message>
<message><source>the file does not say where the sensor is; it is put at the paraxial focus for infinity</source><translation>die Datei sagt nicht, wo der Sensor steht; er kommt in den paraxialen Fokus für unendlich</translation></message>
<message><source>the file has over {count} lines; a prescription is far smaller</source><translation>die Datei hat über {count} Zeilen; ein Objektiv ist viel kleiner</translation></message>
<message><source>the file holds {count} positions, of which {read} are so many zooms at every distance; these are read</source><translation>die Datei enthält {count} Stellungen, von denen {read} bei jedem Abstand gleich viele Zoomstellungen sind; diese werden gelesen</translation></message>
<message><source>the file holds {count} positions; the first {most} are read</source><translation>die Datei enthält {count} Stellungen; die ersten {most} werden gelesen</translation></message>
<message><source>the file holds {count} surfaces; at most {most} are read</source><translation>die Datei enthält {count} Flächen; höchstens {most} werden gelesen</translation></message>
<message><source>the file is empty; write into it, or name another</source><translation>die Datei ist leer; etwas hineinschreiben oder eine andere nennen</translation></message>
<message><source>the file is in none of the known formats: {formats}</source><translation>die Datei hat keines der hier bekannten Formate: {formats}</translation></message>
<message><source>the file is larger than {size} bytes; this is not a lens file</source><translation>die Datei ist größer als {size} Byte; das ist keine Objektivdatei</translation></message>
<message><source>the file is not UTF-8 text; save it as UTF-8</source><translation>die Datei ist kein UTF-8-Text; als UTF-8 speichern</translation></message>
<message><source>the file is not text but binary; give the lens as a text file</source><translation>die Datei ist kein Text, sondern binär; das Objektiv als Textdatei angeben</translation></message>
<message><source>the file is over {size:g} MB; a prescription is far smaller</source><translation>die Datei ist über {size:g} MB groß; ein Objektiv ist viel kleiner</translation></message>
<message><source>the file states no aperture, no stop and no semi-diameter; add one of them</source><translation>die Datei nennt weder Öffnung noch Blende noch Halbmesser; eines davon hinzufügen</translation></message>
<message><source>the file's model is incomplete ({reason}); save it again</source><translation>Das Modell der Datei ist unvollständig ({reason}); bitte neu speichern</translation></message>
<message><source>{value:.6g} mm</source><translation>{value:.6g} mm</translation></message>
<message><source>the file's object is at {depth}, where sources stand unless they are placed elsewhere</source><translation>das Objekt der Datei liegt bei {depth}; dort stehen Quellen, wenn nichts anderes angegeben ist</translation></message>
<message><source>the file does not say where its object is; sources stand at {depth} unless they are placed elsewhere</source><translation>die Datei sagt nicht, wo ihr Objekt liegt; Quellen stehen bei {depth}, wenn nichts anderes angegeben ist</translation></message>
<message><source>the file does not say where its object is; sources stand in focus at {depth} unless placed elsewhere</source><translation>die Datei sagt nicht, wo ihr Objekt liegt; Quellen stehen scharf abgebildet bei {depth}, wenn nichts anderes angegeben ist</translation></message>
<message><source>the configurations differ only by the object's distance; that of the first is read</source><translation>die Konfigurationen unterscheiden sich nur im Objektabstand; der erste wird gelesen</translation></message>
<message><source>the file's object is at {distance:.6g} mm, not before the first surface, where alone a source can stand</source><translation>das Objekt der Datei liegt bei {distance:.6g} mm und nicht vor der ersten Fläche, wo allein eine Quelle stehen kann</translation></message>
<message><source>the object distance is {distance} mm; give a positive number up to {most:g}, or inf</source><translation>der Objektabstand ist {distance} mm; eine positive Zahl bis {most:g} oder inf angeben</translation></message>
<message><source>write a positive number up to 1e16, or inf</source><translation>eine positive Zahl bis 1e16 oder inf schreiben</translation></message>
<message><source>its extra data (XDAT {places}) are left out, since a surface of type {kind} has none</source><translation>ihre Zusatzdaten (XDAT {places}) werden weggelassen, denn eine Fläche vom Typ {kind} hat keine</translation></message>
<message><source>radius {radius:.7g} of the aspherical data is {off:.2g} off that of the lens data, which is taken</source><translation>der Radius {radius:.7g} der Asphärendaten weicht um den Anteil {off:.2g} von dem der Linsendaten ab, der genommen wird</translation></message>
<message><source>surface {due} is missing before surface {number}; add it, or close the gap in the numbers</source><translation>vor Fläche {number} fehlt Fläche {due}; sie ergänzen oder die Lücke in den Nummern schließen</translation></message>
<message><source>the configurations ignore different surfaces ({names}); the present one, {number}, is read alone</source><translation>die Konfigurationen lassen verschiedene Flächen aus ({names}); nur die gegenwärtige, {number}, wird gelesen</translation></message>
<message><source>the last row is the image</source><translation>die letzte Zeile ist das Bild</translation></message>
<message><source>the lens has a diffractive element (DOE) of type {kind}, which is not read; take the block out to read the lens without it</source><translation>das Objektiv hat ein diffraktives Element (DOE) vom Typ {kind}, das nicht gelesen wird; den Block herausnehmen, um das Objektiv ohne es zu lesen</translation></message>
<message><source>{glass} is in no catalogue; accept nd {nd:g} and vd {vd:g} of the same line, or give its AGF catalogue</source><translation>{glass} steht in keinem Katalog; nd {nd:g} und vd {vd:g} derselben Zeile annehmen oder seinen AGF-Katalog angeben</translation></message>
<message><source>{glass} is not known; nd {nd:g} and vd {vd:g}, which the file has beside its name, are taken</source><translation>{glass} ist nicht bekannt; nd {nd:g} und vd {vd:g}, die in der Datei neben seinem Namen stehen, werden genommen</translation></message>
<message><source>the fill factor is {fill:g}; give a part above 0 and up to 1</source><translation>der Füllfaktor ist {fill:g}; einen Teil über 0 und bis 1 angeben</translation></message>
<message><source>the filter in the stop lets no light through; make its apodisation wider</source><translation>das Filter in der Blende lässt kein Licht durch; seine Apodisation breiter machen</translation></message>
<message><source>the fit was cancelled before it was done</source><translation>die Anpassung wurde abgebrochen, bevor sie fertig war</translation></message>
<message><source>the flat field is not brighter than the dark field; expose it longer</source><translation>das Hellbild ist nicht heller als das Dunkelbild; es länger belichten</translation></message>
<message><source>the focus is stated twice, by {first} and {second}; keep one</source><translation>der Fokus ist zweimal angegeben, durch {first} und {second}; eines behalten</translation></message>
<message><source>the forming of images</source><translation>die Bilderzeugung</translation></message>
<message><source>the fourth column as the rim's diameter</source><translation>die vierte Spalte als Durchmesser des Rands</translation></message>
<message><source>the free pupil has no lens</source><translation>die freie Pupille hat kein Objektiv</translation></message>
<message><source>the glass behind surface {surface} has a thickness of {thickness:g} mm, opposite to the direction of light; change its sign or its neighbours</source><translation>das Glas hinter Fläche {surface} ist {thickness:g} mm dick, gegen die Richtung des Lichts; sein Vorzeichen oder seine Nachbarn ändern</translation></message>
<message><source>the glass has no coefficients (CD line); complete it</source><translation>das Glas hat keine Koeffizienten (Zeile CD); ergänzen</translation></message>
<message><source>the glass has no wavelength range (LD line); complete it</source><translation>das Glas hat keinen Wellenlängenbereich (Zeile LD); ergänzen</translation></message>
<message><source>the glass's range is {low:g} to {high:g} µm; give the smaller first, both positive</source><translation>der Bereich des Glases ist {low:g} bis {high:g} µm; das kleinere zuerst angeben, beide positiv</translation></message>
<message><source>the header has no end; close it with a line "{fence}"</source><translation>der Kopf hat kein Ende; ihn mit einer Zeile "{fence}" schließen</translation></message>
<message><source>the header lacks "{name}"; add a line such as {name}: …</source><translation>dem Kopf fehlt "{name}"; eine Zeile hinzufügen wie {name}: …</translation></message>
<message><source>the image height</source><translation>die Bildhöhe</translation></message>
<message><source>the image is at infinity, so no sensor position is in focus; move the source</source><translation>das Bild liegt im Unendlichen, also ist kein Sensorort scharf; die Quelle verschieben</translation></message>
<message><source>the image lies at infinity, so the sensor sees no blur of finite size; move the object</source><translation>das Bild liegt im Unendlichen, der Sensor sieht also keine Unschärfe endlicher Größe; das Objekt verschieben</translation></message>
<message><source>the image of this object lies at infinity (NA 0), so the sensor contains no PSF; move the object or refocus</source><translation>das Bild dieses Objekts liegt im Unendlichen (NA 0), auf dem Sensor gibt es also keine PSF; das Objekt verschieben oder neu fokussieren</translation></message>
<message><source>the image surface</source><translation>die Bildfläche</translation></message>
<message><source>the image surface has more terms than a radius and a conic constant; these two are read, the rest is not</source><translation>die Bildfläche hat mehr Terme als Radius und Kegelschnittkonstante; diese beiden werden gelesen, der Rest nicht</translation></message>
<message><source>the last thickness as the distance to the sensor</source><translation>die letzte Dicke als Abstand zum Sensor</translation></message>
<message><source>the layout</source><translation>der Aufbau</translation></message>
<message><source>the sensor is curved, which a file that ends in {ending} cannot express; save as TOML</source><translation>der Sensor ist gekrümmt, was eine Datei auf {ending} nicht ausdrücken kann; als TOML speichern</translation></message>
<message><source>the sensor's conic constant is {conic}; give a finite number</source><translation>die Kegelschnittkonstante des Sensors ist {conic}; eine endliche Zahl angeben</translation></message>
<message><source>the sensor's radius is {radius} mm; write inf for a plane</source><translation>der Radius des Sensors ist {radius} mm; inf für eine Ebene schreiben</translation></message>
<message><source>the lens</source><translation>das Objektiv</translation></message>
<message><source>the lens as built is the designed lens with its departures; measure relative to the lens</source><translation>das gebaute Objektiv ist das entworfene mit seinen Abweichungen: neben dem Objektiv messen</translation></message>
<message><source>the lens has a zoom ring and a focus ring, but a Zemax file has one list of configurations; save as TOML</source><translation>das Objektiv hat einen Zoomring und einen Fokusring, eine Zemax-Datei eine Liste von Konfigurationen; als TOML speichern</translation></message>
<message><source>the lens has mirrors, which an ISET file cannot express; save as TOML</source><translation>das Objektiv hat Spiegel, die eine ISET-Datei nicht sagen kann; als TOML speichern</translation></message>
<message><source>the lens has no surfaces; give at least one</source><translation>das Objektiv hat keine Flächen; mindestens eine angeben</translation></message>
<message><source>the lens has no surfaces; write a [[surface]] for each</source><translation>das Objektiv hat keine Flächen; für jede ein [[surface]] schreiben</translation></message>
<message><source>the lens has {across} field angles along x for {count} along y; give as many, or none</source><translation>das Objektiv hat {across} Feldwinkel entlang x auf {count} entlang y; ebenso viele angeben oder keine</translation></message>
<message><source>the weights of {count} wavelengths are {weights}; give one that is not negative for each, or none</source><translation>die Gewichte von {count} Wellenlängen sind {weights}; je eines angeben, das nicht negativ ist, oder keines</translation></message>
<message><source>the reference wavelength {reference:g} nm is none of the lens's, {wavelengths:g} nm; choose one of these</source><translation>die Bezugswellenlänge {reference:g} nm ist keine des Objektivs, {wavelengths:g} nm; eine von diesen wählen</translation></message>
<message><source>weights of the wavelengths, as the spectrum {spectrum}</source><translation>Gewichte der Wellenlängen, als Spektrum {spectrum}</translation></message>
<message><source>write a weight that is not negative</source><translation>ein Gewicht schreiben, das nicht negativ ist</translation></message>
<message><source>weight of a wavelength</source><translation>Gewicht einer Wellenlänge</translation></message>
<message><source>flag of the aperture</source><translation>Kennziffer der Öffnung</translation></message>
<message><source>ray aiming</source><translation>Strahlausrichtung</translation></message>
<message><source>rays beside the chief ray do not reach the sensor; reduce the field</source><translation>Strahlen neben dem Hauptstrahl erreichen den Sensor nicht; das Feld verkleinern</translation></message>
<message><source>rays do not meet the sphere in the exit pupil; stop the lens down</source><translation>Strahlen treffen die Kugel in der Austrittspupille nicht; abblenden</translation></message>
<message><source>object cone angle</source><translation>Kegelwinkel am Objekt</translation></message>
<message><source>the file aims rays at the paraxial image of the stop; here they are aimed at the stop itself</source><translation>die Datei richtet die Strahlen auf das paraxiale Bild der Blende; hier werden sie auf die Blende selbst gerichtet</translation></message>
<message><source>{name} ({count}×)</source><translation>{name} ({count}×)</translation></message>
<message><source>unknown here, and not read</source><translation>hier unbekannt und nicht gelesen</translation></message>
<message><source>its obscuration or hole ({name} {kind}) is left out, so the picture shows the full aperture</source><translation>ihre Abschattung oder ihr Loch ({name} {kind}) ist weggelassen, das Bild zeigt also die volle Öffnung</translation></message>
<message><source>the pupil's apodisation differs between x and y ({x:g}, {y:g}), which is not read; give it round</source><translation>die Apodisation der Pupille ist in x und y verschieden ({x:g}, {y:g}), was nicht gelesen wird; rund angeben</translation></message>
<message><source>the pupil's apodisation (GFAC {kind:g}) is left out; its light is even here</source><translation>die Apodisation der Pupille (GFAC {kind:g}) ist weggelassen; ihr Licht ist hier gleichmäßig</translation></message>
<message><source>the pupil's amplitude falls to 1/e at {radius:.6g} of its rim's radius</source><translation>die Amplitude der Pupille fällt bei {radius:.6g} ihres Randradius auf 1/e</translation></message>
<message><source>temperature or pressure</source><translation>Temperatur oder Druck</translation></message>
<message><source>indices are those at 20 °C and 1 atm, not at {temperature:g} °C and {pressure:g} atm; they differ by some 1e-5</source><translation>die Brechzahlen sind die bei 20 °C und 1 atm, nicht bei {temperature:g} °C und {pressure:g} atm; sie weichen um etwa 1e-5 ab</translation></message>
<message><source>the glasses stand at {temperature:g} °C and {pressure:g} atm, but their indices are known at 20 °C in air of 1 atm only; set these in the program that wrote the file, and save it again</source><translation>die Gläser stehen bei {temperature:g} °C und {pressure:g} atm, ihre Brechzahlen sind aber nur bei 20 °C in Luft von 1 atm bekannt; diese Werte im Programm einstellen, das die Datei geschrieben hat, und neu speichern</translation></message>
<message><source>a plane at the object, which does nothing, is left out</source><translation>eine Ebene am Objekt, die nichts bewirkt, wird weggelassen</translation></message>
<message><source>the lens has no wavelengths; give at least one</source><translation>das Objektiv hat keine Wellenlängen; mindestens eine angeben</translation></message>
<message><source>the lens is set aside, and only the six sliders make the picture; switch "Free pupil" off to see the lens</source><translation>das Objektiv ist beiseitegelegt, allein die sechs Regler machen das Bild; „Freie Pupille“ ausschalten, um es zu sehen</translation></message>
<message><source>the lens itself</source><translation>ganz vorn am Objektiv</translation></message>
<message><source>the lens names no stop surface and no semi-diameters; state one of them</source><translation>das Objektiv nennt weder Blendenfläche noch Halbmesser; eines davon angeben</translation></message>
<message><source>the lens states no semi-diameters, so nothing can be clipped; add them or leave {parameter} off</source><translation>das Objektiv nennt keine Halbmesser, also lässt sich nichts beschneiden; diese hinzufügen oder {parameter} auslassen</translation></message>
<message><source>the lens's own</source><translation>die des Objektivs</translation></message>
<message><source>the line has over {count} characters; this is not a lens file</source><translation>die Zeile hat über {count} Zeichen; das ist keine Objektivdatei</translation></message>
<message><source>the link</source><translation>der Link</translation></message>
<message><source>the link contains no state of the explorer; copy it again from the explorer</source><translation>der Link enthält keinen Zustand des Explorers; im Explorer neu kopieren</translation></message>
<message><source>the link is cut off or changed; copy all of it again, from p2sf: to its last letter</source><translation>der Link ist abgeschnitten oder verändert; noch einmal ganz kopieren, von p2sf: bis zum letzten Zeichen</translation></message>
<message><source>the pupil mask leaves nothing open; make its obscuration or its vanes smaller</source><translation>die Maske in der Blende lässt nichts offen; ihre Abschattung oder ihre Streben kleiner machen</translation></message>
<message><source>the measurement was cancelled before it was done</source><translation>die Messung wurde abgebrochen, bevor sie fertig war</translation></message>
<message><source>the medium behind it</source><translation>das Medium dahinter</translation></message>
<message><source>the microlens array is left out; the picture is that of the lens before it</source><translation>das Mikrolinsenraster ist weggelassen; das Bild ist das des Objektivs davor</translation></message>
<message><source>the middle pixel holds {real} % of the light, of a perfect lens's {perfect} %</source><translation>das mittlere Pixel hält {real} % des Lichts, von dem einer idealen Linse {perfect} %</translation></message>
<message><source>the model glass's deviation in partial dispersion is left out; n changes by less than 1e-4</source><translation>die Abweichung der Teildispersion des Modellglases ist weggelassen; n ändert sich um weniger als 1e-4</translation></message>
<message><source>the noise is {noise:g}; give the standard deviation of the picture's noise, above 0</source><translation>das Rauschen ist {noise:g}; die Standardabweichung des Bildrauschens angeben, über 0</translation></message>
<message><source>the object height</source><translation>die Objekthöhe</translation></message>
<message><source>the object is tilted or decentred ({command}), which is not read; move the lens instead</source><translation>das Objekt ist gekippt oder dezentriert ({command}), was nicht gelesen wird; stattdessen das Objektiv bewegen</translation></message>
<message><source>the object is tilted or decentred, which is not read; move the lens instead</source><translation>das Objekt ist gekippt oder dezentriert, was nicht gelesen wird; stattdessen das Objektiv bewegen</translation></message>
<message><source>the object lies at the first vertex, where no aperture angle fills the stop; move it</source><translation>das Objekt liegt im ersten Scheitel, wo ein Öffnungswinkel keine Blende füllt; verschieben</translation></message>
<message><source>the object lies in the entrance pupil, so no cone of light is defined; move the object</source><translation>das Objekt liegt in der Eintrittspupille, also ist kein Lichtkegel festgelegt; das Objekt verschieben</translation></message>
<message><source>the object stands in a medium, which an ISET file cannot express; save as TOML</source><translation>das Objekt steht in einem Medium, was eine ISET-Datei nicht sagen kann; als TOML speichern</translation></message>
<message><source>the object's height of {height:g} as an angle, for it is far away</source><translation>die Objekthöhe {height:g} als Winkel, denn das Objekt ist sehr weit entfernt</translation></message>
<message><source>the open tab</source><translation>das offene Blatt</translation></message>
<message><source>the paraxial pupil</source><translation>die paraxiale Pupille</translation></message>
<message><source>the photo has {count:.3g} megapixels, of which {most:g} at most are sharpened at once; choose a part of it</source><translation>das Foto hat {count:.3g} Megapixel, von denen höchstens {most:g} auf einmal geschärft werden; einen Teil davon wählen</translation></message>
<message><source>the picture has the shape ({shape}), but the scene's sensor needs {rows} rows, {columns} columns and {channels} channels; resize it or change the scene</source><translation>das Bild hat die Form ({shape}), aber der Sensor der Szene verlangt {rows} Zeilen, {columns} Spalten und {channels} Kanäle; seine Größe anpassen oder die Szene ändern</translation></message>
<message><source>the picture holds whole numbers, as codes of sRGB are; convert it to linear light, in floats with white 1</source><translation>das Bild enthält ganze Zahlen wie die Codes von sRGB; wandeln Sie es in lineares Licht um, in Gleitkommazahlen mit Weiß bei 1</translation></message>
<message><source>the picture was cancelled before it was done</source><translation>das Bild wurde abgebrochen, bevor es fertig war</translation></message>
<message><source>the picture {name} is not in {folder} any more; put it back there, or choose another</source><translation>das Bild {name} ist nicht mehr in {folder}; dorthin zurücklegen oder ein anderes wählen</translation></message>
<message><source>the pupil</source><translation>die Pupille</translation></message>
<message><source>the pupil is too distorted for polynomials over its spatial frequencies, which give {share:.3g} times its light; stop the lens down or reduce the field</source><translation>die Pupille ist zu verzerrt für Polynome über ihren Ortsfrequenzen, die das {share:.3g}-Fache ihres Lichts finden; abblenden oder das Feld verkleinern</translation></message>
<message><source>the range to play is {value}; give where it begins and where it ends</source><translation>der Bereich zum Abspielen ist {value}; angeben, wo er beginnt und wo er endet</translation></message>
<message><source>the real stop</source><translation>die wahre Blende</translation></message>
<message><source>the reference is summed when the sliders rest</source><translation>die Referenz wird summiert, wenn die Regler ruhen</translation></message>
<message><source>the reference itself, since {because}</source><translation>die Referenz selbst, denn {because}</translation></message>
<message><source>the reference was cancelled before it was done</source><translation>die Referenz wurde abgebrochen, bevor sie fertig war</translation></message>
<message><source>the rim of surface {rim} is narrower for this object than the stop on surface {stop}; the stop is kept, choose stop auto to use the narrowest rim</source><translation>der Rand von Fläche {rim} ist für dieses Objekt enger als die Blende auf Fläche {stop}; die Blende bleibt, die Wahl „gefunden“ lässt den engsten Rand entscheiden</translation></message>
<message><source>the rims clip every ray of this field; leave {parameter} off or reduce the field</source><translation>die Ränder nehmen jeden Strahl dieses Feldes weg; {parameter} auslassen oder das Feld verkleinern</translation></message>
<message><source>the root of the sphere on its other side</source><translation>die Lösung auf der anderen Seite der Kugel</translation></message>
<message><source>the row cannot be cut into cells ({reason}); correct it</source><translation>die Zeile lässt sich nicht in Zellen teilen ({reason}); berichtigen</translation></message>
<message><source>the scene</source><translation>die Szene</translation></message>
<message><source>the scene has no channel; give at least one</source><translation>die Szene hat keinen Kanal; mindestens einen angeben</translation></message>
<message><source>the scene has one depth</source><translation>die Szene hat nur einen Abstand</translation></message>
<message><source>the scene reaches from {near:g} mm to {far:g} mm; give positive depths, the near one first</source><translation>die Szene reicht von {near:g} mm bis {far:g} mm; positive Abstände angeben, den nahen zuerst</translation></message>
<message><source>the sensitivities were cancelled before they were known</source><translation>die Empfindlichkeiten wurden angehalten, bevor sie bekannt waren</translation></message>
<message><source>the shipped lenses are missing; install p2sf again</source><translation>die mitgelieferten Objektive fehlen; p2sf neu installieren</translation></message>
<message><source>the phase that {numbers} numbers leave over is that small</source><translation>die Phase, die {numbers} Zahlen übrig lassen, ist so klein</translation></message>
<message><source>the source has values of shape {shape}, so it describes many sources; give one at a time</source><translation>die Quelle hat Werte der Form {shape}, das sind viele Quellen; eine nach der anderen angeben</translation></message>
<message><source>the source is on the axis: no chief ray, so the diagram is a line</source><translation>die Quelle liegt auf der Achse: kein Hauptstrahl, das Diagramm ist also eine Linie</translation></message>
<message><source>the spectral lines are as bright as {weights:g}; give numbers that are not negative, as in lines:486@0.5,588</source><translation>die Spektrallinien sind so hell wie {weights:g}; nicht negative Zahlen angeben, wie in lines:486@0.5,588</translation></message>
<message><source>the spectral lines are {given:g} nm; give wavelengths from {least:g} to {most:g} nm, as in lines:486,588,656</source><translation>die Spektrallinien sind {given:g} nm; Wellenlängen von {least:g} bis {most:g} nm angeben, wie in lines:486,588,656</translation></message>
<message><source>the spectrum "{kind}" is unknown; choose {examples}</source><translation>das Spektrum "{kind}" ist unbekannt; {examples} wählen</translation></message>
<message><source>the spectrum "{kind}" takes no number, but has {number:g}; write {examples}</source><translation>das Spektrum "{kind}" hat keine Zahl, auch nicht {number:g}; {examples} schreiben</translation></message>
<message><source>the spectrum "{text}" contains "{rest}", which is not a list of numbers; write {examples}</source><translation>das Spektrum "{text}" enthält "{rest}", was keine Liste von Zahlen ist; {examples} schreiben</translation></message>
<message><source>the spectrum {name} has no visible light; choose another</source><translation>das Spektrum {name} hat kein Licht, das das Auge sieht; eines mit Licht wählen</translation></message>
<message><source>the stage</source><translation>die Bühne</translation></message>
<message><source>the state</source><translation>der Zustand</translation></message>
<message><source>the state has an unknown entry "{entry}"; known are {known}</source><translation>der Zustand hat einen unbekannten Eintrag "{entry}"; bekannt sind {known}</translation></message>
<message><source>the state has no entry "{name}"; choose {names}</source><translation>der Zustand hat keinen Eintrag „{name}“; wählen Sie {names}</translation></message>
<message><source>the state inside {name}</source><translation>der Zustand in {name}</translation></message>
<message><source>the state names no lens; give the name of a shipped lens or a path</source><translation>der Zustand nennt kein Objektiv; den Namen eines mitgelieferten Objektivs oder einen Pfad angeben</translation></message>
<message><source>the state's edited lens is not text; leave lens_text out to take the lens as its file has it</source><translation>das bearbeitete Objektiv des Zustands ist kein Text; lens_text weglassen, um das Objektiv zu nehmen, wie es in der Datei steht</translation></message>
<message><source>the state's group "{group}" is not a table; save it again from the explorer</source><translation>die Gruppe "{group}" des Zustands ist keine Tabelle; im Explorer neu speichern</translation></message>
<message><source>the state's lists are nested too deep; save it again from the explorer</source><translation>die Listen des Zustands sind zu tief verschachtelt; im Explorer neu speichern</translation></message>
<message><source>the state's {name} must be a list of names; correct it or leave it out</source><translation>{name} des Zustands muss eine Liste von Ansichtenamen sein; berichtigen Sie sie oder lassen Sie sie weg</translation></message>
<message><source>the stop alone</source><translation>die Blende allein</translation></message>
<message><source>the stop changes with depth or wavelength; a database holds one stop, choose it</source><translation>die Blende wechselt mit Abstand oder Wellenlänge; eine Datenbank enthält eine Blende, diese wählen</translation></message>
<message><source>the stop is no plane in an air gap, so it cannot be moved alone; insert a plane and put the stop there</source><translation>die Blende ist keine ebene Fläche in einem Luftabstand und lässt sich nicht allein verschieben; fügen Sie eine ebene Fläche ein und legen Sie die Blende dorthin</translation></message>
<message><source>the stop is on the object or the image; put it on a surface between</source><translation>die Blende liegt auf dem Objekt oder dem Bild; auf eine Fläche dazwischen legen</translation></message>
<message><source>the stop on surface {surface} has a semi-diameter of {rim:.6g} mm, but with a radius of {radius:g} mm that surface ends at {edge:.6g} mm; stop the lens down or move the stop</source><translation>die Blende auf Fläche {surface} hat einen Halbmesser von {rim:.6g} mm, aber ein Radius von {radius:g} mm lässt diese Fläche bei {edge:.6g} mm enden; abblenden oder die Blende versetzen</translation></message>
<message><source>the stop, surface {number}, is open to its rim, semi-diameter {rim:g} mm</source><translation>die Blende, Fläche {number}, ist bis zum Rand offen, Halbmesser {rim:g} mm</translation></message>
<message><source>even terms cannot describe the odd powers of the radius in the surface; keep its shape</source><translation>die Fläche hat ungerade Potenzen des Radius, die keine geraden Glieder beschreiben; ihre Form behalten</translation></message>
<message><source>the target fits the picture in {count} ways, and is taken to be upright and in the middle; give it a point that no symmetry repeats</source><translation>Die Zielkarte passt auf {count} Arten auf das Bild und wird aufrecht und in der Mitte angenommen; ihr einen Punkt geben, den keine Symmetrie wiederholt</translation></message>
<message><source>the target's points are in mm, and it is infinitely far away; give {parameter}, or angles in degrees</source><translation>Die Punkte der Zielkarte sind in mm, und sie ist unendlich weit weg; {parameter} oder Winkel in Grad angeben</translation></message>
<message><source>the tolerance</source><translation>die Toleranz</translation></message>
<message><source>the tolerance is measured as "{measure}"; choose {choices}</source><translation>die Toleranz ist als "{measure}" gemessen; {choices} wählen</translation></message>
<message><source>the tolerance of {kind} at surface {surface} is {amount}; give a finite number, 0 or more</source><translation>die Toleranz von {kind} an Fläche {surface} ist {amount}; eine endliche Zahl angeben, 0 oder mehr</translation></message>
<message><source>the transfer function was stopped</source><translation>die Übertragungsfunktion wurde angehalten</translation></message>
<message><source>the wavefront changes by {step:.3g} waves from one cell to the next, and more than {most:g} is ambiguous; give it on a finer grid, without jumps of whole waves</source><translation>die Wellenfront ändert sich von einer Zelle zur nächsten um {step:.3g} Wellen, und mehr als {most:g} ist mehrdeutig; auf einem feineren Gitter angeben, ohne Sprünge um ganze Wellen</translation></message>
<message><source>a pupil is made by p2sf.Pupil.from_opd(opd_waves, na, wavelength_nm)</source><translation>eine Pupille entsteht durch p2sf.Pupil.from_opd(opd_waves, na, wavelength_nm)</translation></message>
<message><source>the wavefront has the shape {shape}; give a square array</source><translation>die Wellenfront hat die Form {shape}; eine quadratische Matrix angeben</translation></message>
<message><source>the window of {width:.4g} µm holds {share:.3g} % of the light, and the PSF has unit sum within it; give more {pixels} or a larger {pixel}</source><translation>das Fenster von {width:.4g} µm enthält {share:.3g} % des Lichts, und die PSF hat darin die Summe 1; geben Sie mehr {pixels} oder ein größeres {pixel} an</translation></message>
<message><source>the {axis} nodes must be one or more numbers in ascending order; sort them</source><translation>die Knoten für {axis} müssen eine oder mehrere Zahlen in steigender Folge sein; ordnen</translation></message>
<message><source>end of the axes</source><translation>Ende der Achsen</translation></message>
<message><source>held_scales is {value}; give pairs such as psf 30, of {panels}</source><translation>held_scales ist {value}; Paare wie psf 30 angeben, von {panels}</translation></message>
<message><source>held_scales is {value}; name each panel once</source><translation>held_scales ist {value}; jede Ansicht einmal nennen</translation></message>
<message><source>the {quantity} "{text}" has the unit "{unit}"; {remedy}</source><translation>"{text}" hat die Einheit "{unit}" bei: {quantity}; {remedy}</translation></message>
<message><source>the {quantity} "{text}" is not a number; write one such as 12.5</source><translation>{quantity}: "{text}" ist keine Zahl; eine wie 12,5 schreiben</translation></message>
<message><source>their sum</source><translation>ihre Summe</translation></message>
<message><source>there are no builds of this lens yet; wait until Tolerances shows its histogram</source><translation>von diesem Objektiv gibt es noch keine Exemplare; warten, bis Toleranzen sein Histogramm zeigt</translation></message>
<message><source>there are {count} lenses for {due} columns; give one for each</source><translation>es gibt {count} Objektive für {due} Spalten; für jede eines angeben</translation></message>
<message><source>there are {count} steps</source><translation>es gibt {count} Schritte</translation></message>
<message><source>there are {count} workspaces already; delete one that is no longer needed</source><translation>es gibt schon {count} Arbeitsbereiche; löschen Sie einen, der nicht mehr gebraucht wird</translation></message>
<message><source>there is 1 step</source><translation>es gibt 1 Schritt</translation></message>
<message><source>there is no lens as built: {why}</source><translation>es gibt kein Objektiv, wie gebaut: {why}</translation></message>
<message><source>there is no display to open the window on; start it from a desktop session, or under xvfb-run</source><translation>es gibt keinen Bildschirm, auf dem sich das Fenster öffnen ließe; aus einer Desktop-Sitzung oder unter xvfb-run starten</translation></message>
<message><source>there is no frame to write; choose a longer sweep</source><translation>es gibt kein Bild zu schreiben; einen längeren Durchlauf wählen</translation></message>
<message><source>there is no link to paste; copy one that begins with p2sf:</source><translation>kein Link zum Einfügen da; einen kopieren, der mit p2sf: beginnt</translation></message>
<message><source>there is no picture to fit; give at least one</source><translation>es gibt kein Bild zum Anpassen; mindestens eines angeben</translation></message>
<message><source>there is no picture yet; save it when it is on screen</source><translation>es gibt noch kein Bild; speichern, wenn es zu sehen ist</translation></message>
<message><source>there is no readable state in this picture or PSF; open a snapshot, written by the window with Ctrl+E, or with the Image panel open drop a photo</source><translation>in diesem Bild oder dieser PSF ist kein lesbarer Zustand; einen Schnappschuss öffnen, den das Fenster mit Strg+E schreibt, oder bei offener Ansicht „Bild“ ein Foto ablegen</translation></message>
<message><source>there is no step; begin one with a line such as ## A point becomes a patch</source><translation>es gibt keinen Schritt; einen mit einer Zeile beginnen wie ## Aus einem Punkt wird ein Fleck</translation></message>
<message><source>there is no such file; check the path</source><translation>eine solche Datei gibt es nicht; den Pfad prüfen</translation></message>
<message><source>there is no surface {number} in a lens of {count}; choose its row again</source><translation>eine Fläche {number} gibt es in einem Objektiv von {count} nicht; die Zeile noch einmal wählen</translation></message>
<message><source>there is no table [sensor]; add it, with rows, columns and pixel_um under it</source><translation>es gibt keine Tabelle [sensor]; sie hinzufügen, darunter rows, columns und pixel_um</translation></message>
<message><source>there is no usable point in the frame; look at what its points are flagged for</source><translation>in der Aufnahme ist kein brauchbarer Punkt; nachsehen, was gegen ihre Punkte spricht</translation></message>
<message><source>there is nothing to draw; choose another field or wavelength</source><translation>es gibt nichts zu zeichnen; ein anderes Feld oder eine andere Wellenlänge wählen</translation></message>
<message><source>thick exact rays, fine third order</source><translation>dick exakt, fein 3. Ordnung</translation></message>
<message><source>thick tangential, fine sagittal</source><translation>dick tangential, fein sagittal</translation></message>
<message><source>thickness</source><translation>Dicke</translation></message>
<message><source>thickness behind surface {where}</source><translation>Dicke hinter Fläche {where}</translation></message>
<message><source>thickness {number}: {thickness} mm</source><translation>Dicke {number}: {thickness} mm</translation></message>
<message><source>this blur over a window {width:.3g} µm wide needs {rays} rays; bring the sensor nearer to the image, stop down, or show a smaller window</source><translation>diese Unschärfe über ein Fenster von {width:.3g} µm braucht {rays} Strahlen; den Sensor dem Bild nähern, abblenden oder ein kleineres Fenster zeigen</translation></message>
<message><source>this is a database of PSFs, not a lens or a state; use it with p2sf psf, or open its lens</source><translation>das ist eine Datenbank von PSFs, kein Objektiv und kein Zustand; mit p2sf psf benutzen oder ihr Objektiv öffnen</translation></message>
<message><source>this is a folder; name a file in it</source><translation>das ist ein Ordner; eine Datei darin nennen</translation></message>
<message><source>this is a glass catalogue, not a lens; give it beside a lens file</source><translation>das ist ein Glaskatalog, kein Objektiv; neben einer Objektivdatei angeben</translation></message>
<message><source>this is not JSON ({reason}); correct the line</source><translation>das ist kein JSON ({reason}); die Zeile berichtigen</translation></message>
<message><source>this is not TOML ({reason}); correct the line</source><translation>das ist kein TOML ({reason}); die Zeile berichtigen</translation></message>
<message><source>this is not TOML ({reason}); {remedy}</source><translation>das ist kein TOML ({reason}); {remedy}</translation></message>
<message><source>this is the older surfaceArray form, convert it in ISET</source><translation>das ist die ältere Form surfaceArray, in ISET umwandeln</translation></message>
<message><source>this lens</source><translation>dieses Objektiv</translation></message>
<message><source>this lens is for near objects, so choose a nearer depth</source><translation>dieses Objektiv ist für nahe Objekte, also einen kleineren Objektabstand wählen</translation></message>
<message><source>this lens, µm</source><translation>diese Linse, µm</translation></message>
<message><source>this stands before the first step; begin a step with a line ## and its title</source><translation>das steht vor dem ersten Schritt; einen Schritt mit einer Zeile ## und seinem Titel beginnen</translation></message>
<message><source>through the lens</source><translation>durch das Objektiv</translation></message>
<message><source>tilt</source><translation>Verkippung</translation></message>
<message><source>tilt of the 3D view</source><translation>Neigung der 3D-Ansicht</translation></message>
<message><source>tilt of the wavefront's surface</source><translation>Neigung der Wellenfrontfläche</translation></message>
<message><source>tilt or decentre</source><translation>Kippung oder Dezentrierung</translation></message>
<message><source>tilt to +x</source><translation>Kippung nach +x</translation></message>
<message><source>tilt to +y</source><translation>Kippung nach +y</translation></message>
<message><source>tilt x of the sensor</source><translation>Kippung x des Sensors</translation></message>
<message><source>tilt x, surface {where}</source><translation>Verkippung x, Fläche {where}</translation></message>
<message><source>tilt y of the sensor</source><translation>Kippung y des Sensors</translation></message>
<message><source>tilt y, surface {where}</source><translation>Verkippung y, Fläche {where}</translation></message>
<message><source>tilts and decentres of Misalign ×{factor}, rays and those of the file as they are</source><translation>die von Dejustieren ×{factor}, Strahlen und Datei wie sie sind</translation></message>
<message><source>tilts and decentres ×{factor}, rays as they are</source><translation>Kippungen usw. ×{factor}, Strahlen wie sie sind</translation></message>
<message><source>tilts as they are</source><translation>Kippungen wie sie sind</translation></message>
<message><source>tilts ×{factor}</source><translation>Kippungen ×{factor}</translation></message>
<message><source>time</source><translation>Zeit</translation></message>
<message><source>time of a PSF among many, µs</source><translation>Zeit einer PSF unter vielen, µs</translation></message>
<message><source>time of one PSF, ms</source><translation>Zeit einer PSF, ms</translation></message>
<message><source>titles, sessions and computing settings</source><translation>Titel, Sitzungen und Recheneinstellungen</translation></message>
<message><source>to</source><translation>bis</translation></message>
<message><source>to the next or the previous control</source><translation>zum nächsten oder vorigen Bedienteil</translation></message>
<message><source>tolerance</source><translation>Toleranz</translation></message>
<message><source>tolerance "{kind}" is unknown; choose one of {kinds}</source><translation>die Toleranz "{kind}" ist unbekannt; eine von {kinds} wählen</translation></message>
<message><source>tolerance R²</source><translation>Toleranz R²</translation></message>
<message><source>tolerances and merit function</source><translation>Toleranzen und Gütefunktion</translation></message>
<message><source>top and bottom of the photo cut off</source><translation>Foto oben und unten abgeschnitten</translation></message>
<message><source>traced</source><translation>traced</translation></message>
<message><source>traced: exact wavefront</source><translation>traced: exakte Wellenfront</translation></message>
<message><source>trefoil</source><translation>Dreiblattfehler</translation></message>
<message><source>true or false</source><translation>true oder false</translation></message>
<message><source>tungsten 2856 K</source><translation>Glühlampe 2856 K</translation></message>
<message><source>turn of the 3D view</source><translation>Drehung der 3D-Ansicht</translation></message>
<message><source>turn of the wavefront's surface</source><translation>Drehung der Wellenfrontfläche</translation></message>
<message><source>type "{kind}" of a shape is unknown; write one of {kinds}</source><translation>type "{kind}" einer Form ist unbekannt; eine von {kinds} schreiben</translation></message>
<message><source>typed</source><translation>getippt</translation></message>
<message><source>unit "{unit}" is none of {units}; correct it</source><translation>die Einheit "{unit}" ist keine von {units}; berichtigen</translation></message>
<message><source>unit is "{unit}"; write one of {units}</source><translation>die Einheit ist "{unit}"; eines von {units} schreiben</translation></message>
<message><source>up to {nodes}, {precision}</source><translation>bis zu {nodes}, {precision}</translation></message>
<message><source>value</source><translation>Wert</translation></message>
<message><source>vane angle</source><translation>Strebenwinkel</translation></message>
<message><source>vane width</source><translation>Strebenbreite</translation></message>
<message><source>vd is {value}; give an Abbe number between 10 and 120</source><translation>vd ist {value}; eine Abbe-Zahl zwischen 10 und 120 angeben</translation></message>
<message><source>vignetting factors (up to {value:g}) are not applied, since {reason}; only rims clip</source><translation>Vignettierungsfaktoren (bis {value:g}) sind nicht angewandt, da {reason}; nur Ränder beschneiden</translation></message>
<message><source>where rims clip, those of the file end the pupil within {missed:.2g} of its radius of where its vignetting factors (up to {value:g}) end it</source><translation>wo Ränder beschneiden, endet die Pupille durch die der Datei auf {missed:.2g} ihres Radius dort, wo ihre Vignettierungsfaktoren (bis {value:g}) sie enden lassen</translation></message>
<message><source>vignetting factors (up to {value:g}) become clear rims of the surfaces {surfaces}; where rims clip, the pupil ends within {missed:.2g} of its radius of where the factors end it</source><translation>Vignettierungsfaktoren (bis {value:g}) werden zu freien Rändern der Flächen {surfaces}; wo Ränder beschneiden, endet die Pupille auf {missed:.2g} ihres Radius dort, wo die Faktoren sie enden lassen</translation></message>
<message><source>some are of fields along x, or turn or shift the pupil along x</source><translation>einige gehören zu Feldern in x oder drehen oder verschieben die Pupille in x</translation></message>
<message><source>the file states no fields</source><translation>die Datei keine Felder angibt</translation></message>
<message><source>a factor of 1 or more leaves no pupil</source><translation>ein Faktor von 1 oder mehr keine Pupille übrig lässt</translation></message>
<message><source>rays at the edge of a vignetted pupil miss a surface</source><translation>Strahlen am Rand einer vignettierten Pupille eine Fläche verfehlen</translation></message>
<message><source>no rim about the axis stops these rays and none of another field</source><translation>kein Rand um die Achse diese Strahlen aufhält und keine eines anderen Feldes</translation></message>
<message><source>a rim for vignetting factors</source><translation>ein Rand für Vignettierungsfaktoren</translation></message>
<message><source>its {what} by the solve {solve} is {found:.7g} ({unit}); that of the file, {old:.7g}, is kept</source><translation>ihre {what} nach dem Solve {solve} ist {found:.7g} ({unit}); die der Datei, {old:.7g}, bleibt</translation></message>
<message><source>its {what} by the solve {solve} is {found:.9g} ({unit})</source><translation>ihre {what} nach dem Solve {solve} ist {found:.9g} ({unit})</translation></message>
<message><source>a solve</source><translation>ein Solve</translation></message>
<message><source>surface {surface}: its {what} follows from the solve {solve}, {reason}; state the number instead</source><translation>Fläche {surface}: ihre {what} folgt aus dem Solve {solve}, {reason}; geben Sie statt dessen die Zahl an</translation></message>
<message><source>whose ray meets the surface on the axis, or where nothing refracts</source><translation>deren Strahl die Fläche auf der Achse trifft oder wo nichts bricht</translation></message>
<message><source>before which no surface stands</source><translation>vor der keine Fläche steht</translation></message>
<message><source>whose ray leaves parallel to the axis</source><translation>deren Strahl parallel zur Achse austritt</translation></message>
<message><source>whose ray depends on surfaces behind it, before the stop</source><translation>deren Strahl von Flächen dahinter, vor der Blende, abhängt</translation></message>
<message><source>whose ray depends on the whole lens by its aperture</source><translation>deren Strahl durch die Öffnung vom ganzen Objektiv abhängt</translation></message>
<message><source>whose entrance pupil is at infinity</source><translation>deren Eintrittspupille im Unendlichen liegt</translation></message>
<message><source>whose entrance pupil is at the object</source><translation>deren Eintrittspupille am Objekt liegt</translation></message>
<message><source>whose chief ray depends on the whole lens by its fields</source><translation>deren Hauptstrahl durch die Felder vom ganzen Objektiv abhängt</translation></message>
<message><source>the pickup {command} is not evaluated; the numbers that the file states are read</source><translation>der Bezug {command} wird nicht ausgewertet; gelesen sind die Zahlen, die die Datei angibt</translation></message>
<message><source>the solve {command} is not evaluated; the number that the file states is read</source><translation>der Solve {command} wird nicht ausgewertet; gelesen ist die Zahl, die die Datei angibt</translation></message>
<message><source>solves, whose stored values are read</source><translation>Solves, deren gespeicherte Werte gelesen sind</translation></message>
<message><source>vignetting factor</source><translation>Vignettierungsfaktor</translation></message>
<message><source>rays fill the paraxial entrance pupil (aim {aim}), but CODE V aims them at the stop; aim at the stop, or save as TOML</source><translation>Strahlen füllen die paraxiale Eintrittspupille (Ziel {aim}), CODE V zielt aber auf die Blende; zielen Sie auf die Blende, oder speichern Sie als TOML</translation></message>
<message><source>the sensor of the lens is curved, and pictures of points are measured on plane ones; measure single PSFs, or give the lens a plane sensor</source><translation>der Sensor des Objektivs ist gewölbt, und Bilder von Punkten werden auf ebenen gemessen; messen Sie einzelne PSFs, oder geben Sie dem Objektiv einen ebenen Sensor</translation></message>
<message><source>vignetting factors, all of them 0</source><translation>Vignettierungsfaktoren, alle 0</translation></message>
<message><source>wavelength</source><translation>Wellenlänge</translation></message>
<message><source>wavelength number</source><translation>Nummer der Wellenlänge</translation></message>
<message><source>wavelength {wavelength:g} nm is outside the data of {glass} and left out</source><translation>die Wellenlänge {wavelength:g} nm liegt außerhalb der Daten von {glass} und ist weggelassen</translation></message>
<message><source>wavelength {wavelength:g} nm is outside the data of {glass}, {low:g} to {high:g} nm; take it out or change the glass</source><translation>die Wellenlänge {wavelength:g} nm liegt außerhalb der Daten von {glass}, {low:g} bis {high:g} nm; herausnehmen oder das Glas wechseln</translation></message>
<message><source>wavelength {wavelength:g} µm is not light; give micrometres</source><translation>die Wellenlänge {wavelength:g} µm ist kein Licht; Mikrometer angeben</translation></message>
<message><source>wavelength, nm</source><translation>Wellenlänge, nm</translation></message>
<message><source>wavelengths</source><translation>Wellenlängen</translation></message>
<message><source>wavelengths are {wavelengths} nm; give positive numbers</source><translation>die Wellenlängen sind {wavelengths} nm; positive Zahlen angeben</translation></message>
<message><source>waves</source><translation>Wellen</translation></message>
<message><source>waves RMS</source><translation>Wellen RMS</translation></message>
<message><source>waves peak</source><translation>Wellen Spitze</translation></message>
<message><source>weights of fields</source><translation>Gewichte der Felder</translation></message>
<message><source>what is added to {term}</source><translation>was zu {term} hinzukommt</translation></message>
<message><source>what is pinned as B must be one state with nothing pinned in it; pin it again</source><translation>was als B gemerkt ist, muss ein einzelner Zustand sein, in dem nichts gemerkt ist; neu merken</translation></message>
<message><source>what no single term shows</source><translation>was kein einzelnes Glied zeigt</translation></message>
<message><source>what the model does not explain is {ratio:.2g} times the noise, and the errors are enlarged by that; try more numbers, and check the numerical aperture, the pixel and the noise</source><translation>das Modell lässt das {ratio:.2g}-Fache des Rauschens übrig, um das die Fehler vergrößert sind; mehr Zahlen versuchen, und numerische Apertur, Pixel und Rauschen prüfen</translation></message>
<message><source>what-if</source><translation>Was wäre wenn</translation></message>
<message><source>what-if: coefficients altered by hand</source><translation>Was wäre wenn: Koeffizienten von Hand geändert</translation></message>
<message><source>what-if: coefficients altered by hand, so the lens's Huygens reference does not apply; reset them to measure again</source><translation>Was wäre wenn: Koeffizienten von Hand geändert, daher gilt die Huygens-Referenz des Objektivs nicht; setzen Sie sie zurück, um wieder zu messen</translation></message>
<message><source>what-if: {alterations}</source><translation>was wäre wenn: {alterations}</translation></message>
<message><source>wheel, drag, double-click</source><translation>Mausrad, Ziehen, Doppelklick</translation></message>
<message><source>where rims clip, its clear rim is {kind} about ({centre:g}) mm</source><translation>wo Ränder beschneiden, ist ihr freier Rand {kind} um ({centre:g}) mm</translation></message>
<message><source>which P2SF does not trace</source><translation>den P2SF nicht rechnet</translation></message>
<message><source>while something is dragged: give up, as it was before</source><translation>beim Ziehen: aufgeben, alles wie zuvor</translation></message>
<message><source>whole field</source><translation>ganzes Feld</translation></message>
<message><source>whole lens</source><translation>ganzes Objektiv</translation></message>
<message><source>whole pupil</source><translation>ganze Pupille</translation></message>
<message><source>wider than the others, perhaps two points</source><translation>breiter als die anderen, vielleicht zwei Punkte</translation></message>
<message><source>with consent: {title}</source><translation>mit Zustimmung: {title}</translation></message>
<message><source>with wheel, arrows or a dragged number: ten times as coarse, ten times as fine</source><translation>mit Rad, Pfeilen oder beim Ziehen an einer Zahl: zehnmal so grob, zehnmal so fein</translation></message>
<message><source>working</source><translation>in Arbeit</translation></message>
<message><source>worst R² ≥ {r}</source><translation>kleinstes R² ≥ {r}</translation></message>
<message><source>wrapped</source><translation>gefaltet</translation></message>
<message><source>write a finite number</source><translation>eine endliche Zahl schreiben</translation></message>
<message><source>write a finite number, 0 or more</source><translation>eine endliche Zahl schreiben, 0 oder mehr</translation></message>
<message><source>write a number</source><translation>eine Zahl schreiben</translation></message>
<message><source>write a number from 0</source><translation>eine Zahl ab 0 schreiben</translation></message>
<message><source>write a number that is not 0, inf for a plane</source><translation>eine Zahl schreiben, die nicht 0 ist, inf für eine Ebene</translation></message>
<message><source>write a positive number</source><translation>eine positive Zahl schreiben</translation></message>
<message><source>write a share from 0 to 1</source><translation>einen Anteil von 0 bis 1 schreiben</translation></message>
<message><source>write a wavelength in nanometres, 50 to 50000</source><translation>eine Wellenlänge in Nanometern schreiben, 50 bis 50000</translation></message>
<message><source>write an angle in degrees</source><translation>einen Winkel in Grad schreiben</translation></message>
<message><source>write an angle in degrees below 90</source><translation>einen Winkel in Grad unter 90 schreiben</translation></message>
<message><source>write maker and name as in "SCHOTT N-BK7", an index, or { nd = 1.5168, vd = 64.17 }</source><translation>Hersteller und Namen schreiben wie in "SCHOTT N-BK7", einen Index oder { nd = 1.5168, vd = 64.17 }</translation></message>
<message><source>write the distance to the next surface as a number</source><translation>den Abstand zur nächsten Fläche als Zahl schreiben</translation></message>
<message><source>write the number alone</source><translation>die Zahl allein schreiben</translation></message>
<message><source>write the number {number} without quotation marks</source><translation>die Zahl {number} ohne Anführungszeichen schreiben</translation></message>
<message><source>write {number} with a decimal point, not "{found}"</source><translation>{number} mit Dezimalpunkt schreiben, nicht "{found}"</translation></message>
<message><source>write {units} or no unit</source><translation>{units} oder keine Einheit schreiben</translation></message>
<message><source>x {x:z.2f}, y {y:z.2f} µm</source><translation>x {x:z.2f}, y {y:z.2f} µm</translation></message>
<message><source>x, mm</source><translation>x, mm</translation></message>
<message><source>x, of the edge</source><translation>x, des Randes</translation></message>
<message><source>x, µm</source><translation>x, µm</translation></message>
<message><source>x, µm from the chief ray</source><translation>x, µm vom Hauptstrahl</translation></message>
<message><source>y of the paraxial chief ray on the sensor; in focus, the magnification times the object height.</source><translation>y des paraxialen Hauptstrahls auf dem Sensor; scharf gestellt der Abbildungsmaßstab mal die Objekthöhe.</translation></message>
<message><source>y of the source, negative below the axis; none at infinity. A field stated as an object height counts towards −y.</source><translation>y der Quelle, negativ unter der Achse; keines im Unendlichen. Ein als Objekthöhe angegebenes Feld zählt nach −y.</translation></message>
<message><source>y, mm</source><translation>y, mm</translation></message>
<message><source>y, of the edge</source><translation>y, des Randes</translation></message>
<message><source>y, µm</source><translation>y, µm</translation></message>
<message><source>yield, %</source><translation>Ausbeute, %</translation></message>
<message><source>y–ȳ</source><translation>y–ȳ</translation></message>
<message><source>y–ȳ diagram (Delano 1963): marginal ray height against chief ray height at every surface. Where the line crosses ȳ = 0 is the stop or a pupil, where it crosses y = 0 an image.</source><translation>y–ȳ-Diagramm (Delano 1963): Randstrahlhöhe über Hauptstrahlhöhe an jeder Fläche. Wo die Linie ȳ = 0 schneidet, ist die Blende oder eine Pupille, wo sie y = 0 schneidet, ein Bild.</translation></message>
<message><source>z, mm</source><translation>z, mm</translation></message>
<message><source>zoom</source><translation>Zoom</translation></message>
<message><source>zoom positions {columns}; between them the lens is interpolated</source><translation>Zoomstellungen {columns}; dazwischen wird das Objektiv interpoliert</translation></message>
<message><source>zoom {place}</source><translation>Zoom {place}</translation></message>
<message><source>zoom, pan or see the whole of the plot under the pointer; also + −, arrows, Home</source><translation>das Diagramm unter dem Zeiger vergrößern, verschieben, ganz zeigen; auch + −, Pfeile, Pos1</translation></message>
<message><source>{axis} {value:.6g} {unit} is outside this database, which covers {low:.6g} to {high:.6g} {unit}; {remedy}</source><translation>{axis} {value:.6g} {unit} liegt außerhalb dieser Datenbank, die {low:.6g} bis {high:.6g} {unit} umfasst; {remedy}</translation></message>
<message><source>{before} mm before surface {first}, {behind} mm behind {last}</source><translation>{before} mm vor Fläche {first}, {behind} mm hinter {last}</translation></message>
<message><source>{behind} mm behind surface {last}</source><translation>{behind} mm hinter Fläche {last}</translation></message>
<message><source>{cells} cells of the pupil count, too few for {terms} terms; give more, with weights of 0 or more</source><translation>{cells} Zellen der Pupille zählen, zu wenige für {terms} Terme; mehr angeben, mit Gewichten ab 0</translation></message>
<message><source>{choice}: {why} (error {error:.1g})</source><translation>{choice}: {why} (Fehler {error:.1g})</translation></message>
<message><source>{coefficient} is not finite, so there is no wavefront; choose a depth, field or lens with one</source><translation>{coefficient} ist nicht endlich, also gibt es keine Wellenfront; einen Abstand, ein Feld oder ein Objektiv mit einer wählen</translation></message>
<message><source>{coefficient} is {error:.2g} waves off with {terms} terms in wavelength, so the glass data have a kink between the wavelengths asked; build with the linear interpolant, or narrow the wavelengths</source><translation>{coefficient} liegt mit {terms} Gliedern in der Wellenlänge um {error:.2g} Wellen daneben, die Glasdaten haben also einen Knick zwischen den verlangten Wellenlängen; mit der Interpolation linear bauen oder die Wellenlängen einengen</translation></message>
<message><source>{columns} × {rows} pixels of {pitch} µm</source><translation>{columns} × {rows} Pixel zu {pitch} µm</translation></message>
<message><source>{command} is of number {number}, which does not exist yet; put it behind the list of all</source><translation>{command} betrifft Nummer {number}, die es noch nicht gibt; hinter die Liste aller setzen</translation></message>
<message><source>{command} refers to surface {number}, which does not exist yet</source><translation>{command} verweist auf Fläche {number}, die es noch nicht gibt</translation></message>
<message><source>{command} stands before any surface; put it after one</source><translation>{command} steht vor jeder Fläche; hinter eine Fläche stellen</translation></message>
<message><source>{command}: a number is missing; complete the command</source><translation>{command}: Es fehlt eine Zahl; bitte den Befehl ergänzen</translation></message>
<message><source>{command}: {what} is missing; complete the command</source><translation>{command}: {what} fehlt; den Befehl ergänzen</translation></message>
<message><source>{contrast} (at {f:.3g}/mm)</source><translation>{contrast} (bei {f:.3g}/mm)</translation></message>
<message><source>{count:.3g} PSF samples exceed {most:.3g}; choose fewer pixels or fewer PSFs</source><translation>{count:.3g} PSF-Proben sind mehr als {most:.3g}; weniger Pixel oder weniger PSFs verlangen</translation></message>
<message><source>{count} PSFs</source><translation>{count} PSFs</translation></message>
<message><source>{count} PSFs of {pixels}² pixels are {size:.1f} GiB; ask for fewer, or for fewer pixels a side</source><translation>{count} PSFs von {pixels}² Pixeln sind {size:.1f} GiB; weniger verlangen, oder weniger Pixel je Seite</translation></message>
<message><source>{count} blades</source><translation>{count} Lamellen</translation></message>
<message><source>{count} errors of the build</source><translation>{count} Fehler des Baus</translation></message>
<message><source>{count} fits</source><translation>{count} Anpassungen</translation></message>
<message><source>{count} nodes</source><translation>{count} Knoten</translation></message>
<message><source>{count} numbers are off</source><translation>{count} Zahlen stimmen nicht</translation></message>
<message><source>{count} of the drawn rays do not pass (they miss a surface, or are totally reflected); less light arrives than the picture assumes.</source><translation>{count} der gezeichneten Strahlen kommen nicht durch (Fläche verfehlt oder totale Reflexion); es kommt weniger Licht an, als das Bild annimmt.</translation></message>
<message><source>{count} of {all} wavelengths keep the channel's lateral and axial colour</source><translation>{count} von {all} Wellenlängen erhalten Farbquer- und Farblängsfehler des Kanals</translation></message>
<message><source>{count} of {total} PSFs are wider than their windows, which hold as little as {share:.2g} % of the light; ask for more pixels a side, or larger ones</source><translation>{count} von {total} PSFs sind breiter als ihr Fenster, in das zum Teil nur {share:.2g} % des Lichts fallen; mehr Pixel je Seite verlangen, oder größere</translation></message>
<message><source>{count} rays</source><translation>{count} Strahlen</translation></message>
<message><source>{count} samples {pixel_um:.3g} µm apart hold no contrast of a PSF of aperture {na:.3g}: λ/(4 NA) is {critical:.3g} µm; sample it so closely, or take the MTF of the lens</source><translation>{count} Proben im Abstand {pixel_um:.3g} µm halten keinen Kontrast einer PSF der Apertur {na:.3g}: λ/(4 NA) sind {critical:.3g} µm; so dicht abtasten oder die MTF des Objektivs nehmen</translation></message>
<message><source>{count} surfaces</source><translation>{count} Flächen</translation></message>
<message><source>{count} surfaces, {stop}, {aperture}; {wavelengths:g} nm; fields {angles:.4g}°</source><translation>{count} Flächen, {stop}, {aperture}; {wavelengths:g} nm; Felder {angles:.4g}°</translation></message>
<message><source>{count} vanes</source><translation>{count} Streben</translation></message>
<message><source>{count} wavelengths</source><translation>{count} Wellenlängen</translation></message>
<message><source>{count} wavelengths for a colour PSF; give a whole number from 1 to {most}</source><translation>{count} Wellenlängen für eine farbige PSF; eine ganze Zahl von 1 bis {most} angeben</translation></message>
<message><source>{depth:.4g} mm</source><translation>{depth:.4g} mm</translation></message>
<message><source>{depth:g} mm</source><translation>{depth:g} mm</translation></message>
<message><source>PSFs: {count} = depths {depths} × fields {fields} × wavelengths {wavelengths}</source><translation>PSFs: {count} = Abstände {depths} × Felder {fields} × Wellenlängen {wavelengths}</translation></message>
<message><source>{done} of {all} settled</source><translation>{done} von {all} fertig</translation></message>
<message><source>{error:.2g} relative, does not keep {tolerance:g}; the full grid takes {times:.0f} times as long</source><translation>{error:.2g} relativ, hält {tolerance:g} nicht ein; das volle Gitter dauert {times:.0f}-mal so lang</translation></message>
<message><source>{error:.2g} relative, keeps {tolerance:g}; the full grid takes {times:.0f} times as long</source><translation>{error:.2g} relativ, hält {tolerance:g} ein; das volle Gitter dauert {times:.0f}-mal so lang</translation></message>
<message><source>{error}; the field list holds the axis only</source><translation>{error}; die Feldliste enthält nur die Achse</translation></message>
<message><source>{f:g}/mm</source><translation>{f:g}/mm</translation></message>
<message><source>{f_number}, stop ⌀ {diameter} mm</source><translation>{f_number}, Blende ⌀ {diameter} mm</translation></message>
<message><source>{file} is not a PNG, TIFF, FITS, npy, npz or listing; save the picture as one of these and drop that</source><translation>{file} ist kein PNG, TIFF, FITS, npy, npz und keine Liste; das Bild als eines davon speichern und das ablegen</translation></message>
<message><source>{file} is not a PNG, TIFF, OpenEXR, JPEG or HEIF; save the photo as one of these and drop that</source><translation>{file} ist kein PNG, TIFF, OpenEXR, JPEG oder HEIF; das Foto als eines davon speichern und dieses ablegen</translation></message>
<message><source>{first} and {second} have no number in common; measure the same points by the same model</source><translation>{first} und {second} haben keine Zahl gemeinsam; dieselben Punkte mit demselben Modell messen</translation></message>
<message><source>{frames} frames and {focus} focus positions; give one for each</source><translation>{frames} Aufnahmen und {focus} Fokuslagen; für jede eine angeben</translation></message>
<message><source>{glass} is in no catalogue given; accept a substitute ({offers}) or give its AGF catalogue</source><translation>{glass} steht in keinem angegebenen Katalog; einen Ersatz annehmen ({offers}) oder seinen AGF-Katalog angeben</translation></message>
<message><source>{glass} is in no catalogue; give its AGF catalogue, or its index as nd and vd</source><translation>{glass} steht in keinem Katalog; seinen AGF-Katalog angeben oder seinen Index als nd und vd</translation></message>
<message><source>{glass} (nd {nd:.5f})</source><translation>{glass} (nd {nd:.5f})</translation></message>
<message><source>glass {name} is sold with different indices, and the file does not say by whom; {taken} is taken, from which {other} differs by {f_line:+.5f}, {d_line:+.5f}, {c_line:+.5f} at F, d and C</source><translation>Das Glas {name} wird mit verschiedenen Indizes verkauft, und die Datei sagt nicht, von wem; genommen ist {taken}, von dem {other} bei F, d und C um {f_line:+.5f}, {d_line:+.5f}, {c_line:+.5f} abweicht</translation></message>
<message><source>"{name}" is not an object; correct it</source><translation>„{name}“ ist kein Objekt; berichtigen</translation></message>
<message><source>"{text}" can mean two numbers; write {thousands} or {decimals}</source><translation>„{text}“ kann zwei Zahlen bedeuten; {thousands} oder {decimals} schreiben</translation></message>
<message><source>Abbe number</source><translation>Abbe-Zahl</translation></message>
<message><source>a lens lists its "{name}"; add them</source><translation>ein Objektiv führt „{name}“ auf; ergänzen</translation></message>
<message><source>a row needs radius, thickness, index and housing radius; complete it</source><translation>eine Zeile braucht Radius, Dicke, Index und Fassungsradius; ergänzen</translation></message>
<message><source>a row needs radius, thickness, material and housing radius; complete it</source><translation>eine Zeile braucht Radius, Dicke, Material und Fassungsradius; ergänzen</translation></message>
<message><source>a row of glass needs its name, nd, vd and a housing radius; complete it</source><translation>eine Zeile mit Glas braucht dessen Namen, nd, vd und einen Fassungsradius; ergänzen</translation></message>
<message><source>a wavelength is not a pair of nanometres and weight; correct it</source><translation>eine Wellenlänge ist kein Paar aus Nanometern und Gewicht; berichtigen</translation></message>
<message><source>back focal length, mm</source><translation>Schnittweite, mm</translation></message>
<message><source>focal length, mm</source><translation>Brennweite, mm</translation></message>
<message><source>half field, °</source><translation>halbes Feld, °</translation></message>
<message><source>is an ideal lens for one magnification</source><translation>ist eine ideale Linse für einen einzigen Abbildungsmaßstab</translation></message>
<message><source>its rim is square; a round one of the same half-width is used instead</source><translation>ihr Rand ist quadratisch; stattdessen wird ein runder derselben halben Breite benutzt</translation></message>
<message><source>normalization radius {radius:g} is not that of a lens; correct it</source><translation>Normierungsradius {radius:g} ist nicht der eines Objektivs; berichtigen</translation></message>
<message><source>row</source><translation>Zeile</translation></message>
<message><source>scale</source><translation>Maßstab</translation></message>
<message><source>surface {surface} diffracts, which is not read of this format</source><translation>Fläche {surface} beugt, was aus diesem Format nicht gelesen wird</translation></message>
<message><source>surface {surface} has a material of type {kind}, which is not read</source><translation>Fläche {surface} hat ein Material der Art {kind}, die nicht gelesen wird</translation></message>
<message><source>surface {surface} has a rim of type {kind}, which is not read; give a round one</source><translation>Fläche {surface} hat einen Rand der Art {kind}, die nicht gelesen wird; einen runden angeben</translation></message>
<message><source>surface {surface} has an infinite thickness; give a finite one</source><translation>Fläche {surface} hat eine unendliche Dicke; eine endliche angeben</translation></message>
<message><source>surface {surface} has type {kind}, which is not read</source><translation>Fläche {surface} ist von der Art {kind}, die nicht gelesen wird</translation></message>
<message><source>surface {surface} has type {kind}, which is not read; only {known} are</source><translation>Fläche {surface} ist von der Art {kind}, die nicht gelesen wird; nur {known} werden gelesen</translation></message>
<message><source>surface {surface} is tilted by {kind}, which is not read; only {known} are</source><translation>Fläche {surface} ist durch {kind} gekippt, was nicht gelesen wird; nur {known} werden gelesen</translation></message>
<message><source>surface {surface} is tilted or decentred (pos_xy, vec_local), which is not read; centre it</source><translation>Fläche {surface} ist gekippt oder dezentriert (pos_xy, vec_local), was nicht gelesen wird; zentrieren</translation></message>
<message><source>surface {surface} is tilted or decentred, which is not read of this format; centre it</source><translation>Fläche {surface} ist gekippt oder dezentriert, was aus diesem Format nicht gelesen wird; zentrieren</translation></message>
<message><source>surface {surface}: {error}</source><translation>Fläche {surface}: {error}</translation></message>
<message><source>surface {surface}: {name}</source><translation>Fläche {surface}: {name}</translation></message>
<message><source>surface {surface}: {name} is not a list of numbers; correct it</source><translation>Fläche {surface}: {name} ist keine Liste von Zahlen; berichtigen</translation></message>
<message><source>the aperture is of type {kind}, which is not read</source><translation>die Öffnung ist von der Art {kind}, die nicht gelesen wird</translation></message>
<message><source>the fields are of type {kind}, which is not read</source><translation>die Felder sind von der Art {kind}, die nicht gelesen wird</translation></message>
<message><source>the picture is squeezed by {factor}, which is left out</source><translation>das Bild ist um {factor} gestaucht, was weggelassen ist</translation></message>
<message><source>this JSON is a lens of none of the known kinds: {formats}</source><translation>dieses JSON ist kein Objektiv einer bekannten Art: {formats}</translation></message>
<message><source>this JSON is a list and no lens; give one with surfaces</source><translation>dieses JSON ist eine Liste und kein Objektiv; eines mit Flächen angeben</translation></message>
<message><source>track from the first surface to the sensor, mm</source><translation>Baulänge von der ersten Fläche bis zum Sensor, mm</translation></message>
<message><source>{count} surfaces have radius 0; {number} is the stop</source><translation>{count} Flächen haben den Radius 0; {number} ist die Blende</translation></message>
<message><source>{name} is {found}; write a number</source><translation>{name} ist {found}; eine Zahl schreiben</translation></message>
<message><source>{parameter} means nothing without {other}; give both</source><translation>{parameter} bedeutet ohne {other} nichts; beide angeben</translation></message>
<message><source>{path} cannot be read, {reason}; give the path of a CSV file</source><translation>{path} ist nicht lesbar, {reason}; den Pfad einer CSV-Datei angeben</translation></message>
<message><source>{path} is not a table of numbers ({reason}); give nm and a column for each channel, names in the first line</source><translation>{path} ist keine Tabelle von Zahlen ({reason}); nm und eine Spalte je Kanal angeben, mit Namen in der ersten Zeile</translation></message>
<message><source>{path}: give wavelengths that increase, from {low:g} to {high:g} nm, and behind each a response of 0 or more for every channel</source><translation>{path}: steigende Wellenlängen von {low:g} bis {high:g} nm angeben, und zu jeder eine Empfindlichkeit von 0 oder mehr für jeden Kanal</translation></message>
<message><source>{path}: the curve of {name} has no light; correct it</source><translation>{path}: die Kurve von {name} hat kein Licht; sie berichtigen</translation></message>
<message><source>{surface} has type {kind}, which is not read; only {known} are</source><translation>{surface} ist von der Art {kind}, die nicht gelesen wird; nur {known} werden gelesen</translation></message>
<message><source>{what}: the file states {stated:.6g}, its surfaces give {found:.6g} ({off:+.2%})</source><translation>{what}: die Datei nennt {stated:.6g}, ihre Flächen ergeben {found:.6g} ({off:+.2%})</translation></message>
<message><source>a .zos file is in a form of OpticStudio's own; open it there and save it as .zmx or .zar</source><translation>eine .zos-Datei hat eine eigene Form von OpticStudio; dort öffnen und als .zmx oder .zar speichern</translation></message>
<message><source>{glass} replaced by {substitute}; the file does not tell the index it wants</source><translation>{glass} ersetzt durch {substitute}; die Datei nennt den gewünschten Index nicht</translation></message>
<message><source>{glass} shares its name with another maker's glass of this lens; save as TOML</source><translation>{glass} heißt wie das Glas eines anderen Herstellers in diesem Objektiv; als TOML speichern</translation></message>
<message><source>{keyword} is of number {number}, which does not exist; correct it</source><translation>{keyword} betrifft Nummer {number}, die es nicht gibt; berichtigen</translation></message>
<message><source>{keyword} is of surface {number}, which does not exist; correct it</source><translation>{keyword} betrifft Fläche {number}, die es nicht gibt; berichtigen</translation></message>
<message><source>{keyword}: a value is missing; complete the line</source><translation>{keyword}: ein Wert fehlt; die Zeile ergänzen</translation></message>
<message><source>{keyword}: {what} is missing; complete the line</source><translation>{keyword}: {what} fehlt; die Zeile ergänzen</translation></message>
<message><source>{key} is {given}; give a number, without quotes</source><translation>{key} ist {given}; eine Zahl angeben, ohne Anführungszeichen</translation></message>
<message><source>{key} is {given}; give numbers in brackets, such as [530, 560]</source><translation>{key} ist {given}; Zahlen in Klammern angeben wie [530, 560]</translation></message>
<message><source>{key} is {given}; write true or false, without quotes</source><translation>{key} ist {given}; true oder false schreiben, ohne Anführungszeichen</translation></message>
<message><source>{key} of {name} is {records}; write a list of [wavelength in µm, share, thickness in mm]</source><translation>{key} von {name} ist {records}; eine Liste von [Wellenlänge in µm, Anteil, Dicke in mm] schreiben</translation></message>
<message><source>{kind} has its columns at {places}; give finite numbers that ascend</source><translation>{kind} hat seine Spalten bei {places}; endliche, aufsteigende Zahlen angeben</translation></message>
<message><source>{kind} has two columns with the same name: {names}; rename one</source><translation>{kind} hat zwei Spalten eines Namens: {names}; eine umbenennen</translation></message>
<message><source>{kind} has {columns} columns at {places} places; give at least two, and one place for each</source><translation>{kind} hat {columns} Spalten an {places} Orten; mindestens zwei angeben, und für jede einen Ort</translation></message>
<message><source>{kind} of surface {surface} is off by {value}; give a number from {low:g} to {high:g}{unit}</source><translation>{kind} von Fläche {surface} ist um {value} falsch; eine Zahl von {low:g} bis {high:g}{unit} angeben</translation></message>
<message><source>{kind}: normalisation radius {radius:g} mm, coefficients {numbers:.6g} mm</source><translation>{kind}: Normierungsradius {radius:g} mm, Koeffizienten {numbers:.6g} mm</translation></message>
<message><source>{library} is not installed; pip install 'p2sf[xarray]'</source><translation>{library} ist nicht installiert; pip install 'p2sf[xarray]'</translation></message>
<message><source>{lost} of {rays} rays are lost, and a smooth pupil does not describe that</source><translation>{lost} von {rays} Strahlen gehen verloren, und das beschreibt keine glatte Pupille</translation></message>
<message><source>{lost} of {total} rays do not reach the sensor; stop the lens down or reduce the field</source><translation>{lost} von {total} Strahlen erreichen den Sensor nicht; abblenden oder das Feld verkleinern</translation></message>
<message><source>{lost} rays lost</source><translation>{lost} Strahlen verloren</translation></message>
<message><source>auto compares two sums of waves to choose a method, which takes a moment</source><translation>auto vergleicht zwei Wellensummen, um ein Verfahren zu wählen; das dauert einen Moment</translation></message>
<message><source>{method} follows: its sum of waves takes a moment</source><translation>{method} folgt: die Summe der Wellen dauert einen Augenblick</translation></message>
<message><source>{method} here: longer than a frame</source><translation>{method} hier: länger als ein Bild der Bewegung</translation></message>
<message><source>{method} here: {ms} ms, faint light within {percent} % of the most exact method's</source><translation>{method} hier: {ms} ms, schwaches Licht auf {percent} % wie beim genauesten Verfahren</translation></message>
<message><source>{method} here: {ms} ms, {error}</source><translation>{method} hier: {ms} ms, {error}</translation></message>
<message><source>{method} over this whole lens, measured: {what} {half} at 50 % of all points, {most} at 95 %</source><translation>{method} über das ganze Objektiv, gemessen: {what} {half} an der Hälfte aller Punkte, {most} an 95 %</translation></message>
<message><source>{method} vs Huygens: R² {r} in {wide} µm</source><translation>{method} gegen Huygens: R² {r} in {wide} µm</translation></message>
<message><source>{method} vs spherical waves: R² {r} in {wide} µm</source><translation>{method} gegen Kugelwellen: R² {r} in {wide} µm</translation></message>
<message><source>{method} would need {count:.2g} pupil samples for this blur, which takes too long; {remedy}, or choose auto to see ray density</source><translation>{method} bräuchte {count:.2g} Pupillenproben für diese Unschärfe, was zu lange dauert; {remedy} oder auto wählen, um die Strahlendichte zu sehen</translation></message>
<message><source>{method}, by waves of the pupil; the picture is the density of its rays</source><translation>{method}, durch Wellen der Pupille; das Bild ist die Dichte ihrer Strahlen</translation></message>
<message><source>{method}, {count} numbers</source><translation>{method}, {count} Zahlen</translation></message>
<message><source>{method}; {note}</source><translation>{method}; {note}</translation></message>
<message><source>{most} of {count} points of the picture lie where {path} has one, and {least} should; check the file, its unit, the distance, and whether it is that of this picture</source><translation>{most} von {count} Punkten des Bildes liegen, wo {path} einen hat, und {least} sollten es; die Datei, ihre Einheit und die Entfernung prüfen, und ob sie die dieses Bildes ist</translation></message>
<message><source>{names} have the shapes {shapes}, which do not broadcast; give arrays as numpy adds them</source><translation>{names} haben die Formen {shapes}, die numpy nicht zusammen auf eine bringt; Felder angeben, die sich addieren lassen</translation></message>
<message><source>{names}: a database cannot express a tilted sensor; write the lens as a .toml</source><translation>{names}: Eine Datenbank kennt keinen gekippten Sensor; das Objektiv als .toml schreiben</translation></message>
<message><source>{names}: not determined, one standard deviation exceeds {most} waves</source><translation>{names}: nicht bestimmt, eine Standardabweichung übersteigt {most} Wellen</translation></message>
<message><source>{names}: not part of the lens as built; measure spacings instead</source><translation>{names}: kein Teil des gebauten Objektivs; an ihrer Stelle Abstände messen</translation></message>
<message><source>{names}: the picture determines only a combination of these, hardly each of them; leave one out</source><translation>{names}: Das Bild sagt nur eine Verbindung dieser Zahlen und kaum jede einzelne; eine weglassen</translation></message>
<message><source>{name} and {other} are both given; keep one of them</source><translation>{name} und {other} sind beide angegeben; eins davon behalten</translation></message>
<message><source>{name} are {count} numbers; write x and y</source><translation>{name} sind {count} Zahlen; x und y schreiben</translation></message>
<message><source>{name} are {count} numbers; write x, y and z</source><translation>{name} sind {count} Zahlen; x, y und z schreiben</translation></message>
<message><source>{name} cannot be read ({reason}); name a picture or a .npy file</source><translation>{name} lässt sich nicht lesen ({reason}); ein Bild oder eine .npy-Datei nennen</translation></message>
<message><source>{name} has changed on disk and was read again</source><translation>{name} hat sich auf dem Datenträger geändert und wurde neu gelesen</translation></message>
<message><source>{name} has changed on disk; your edits are kept, Back to file takes the new one</source><translation>{name} hat sich auf dem Datenträger geändert; Ihre Änderungen bleiben, „Zurück zur Datei“ nimmt die neue</translation></message>
<message><source>{name} has one list, and the lens has two rings; write {{ zoom = […] }} or {{ focus = […] }}, or a list of lists</source><translation>{name} hat eine Liste, und das Objektiv zwei Ringe; {{ zoom = […] }} oder {{ focus = […] }} schreiben, oder eine Liste von Listen</translation></message>
<message><source>{name} has the ending "{ending}"; give the scene a name in {names}</source><translation>{name} hat die Endung "{ending}"; der Szene einen Namen mit {names} geben</translation></message>
<message><source>{name} has {row}; give {words}, of one of {kinds}</source><translation>{name} hat {row}; {words} angeben, aus {kinds}</translation></message>
<message><source>{name} is "{value}"; choose one of {choices}</source><translation>{name} ist "{value}"; eines von {choices} wählen</translation></message>
<message><source>{name} is "{word}"; give a number</source><translation>{name} ist "{word}"; eine Zahl angeben</translation></message>
<message><source>{name} is an empty list; write at least one number</source><translation>{name} ist eine leere Liste; mindestens eine Zahl schreiben</translation></message>
<message><source>{name} is missing; {remedy}</source><translation>{name} fehlt; {remedy}</translation></message>
<message><source>{name} is not a list of tables; head every one with [[{name}]]</source><translation>{name} ist keine Liste von Tabellen; jede mit [[{name}]] überschreiben</translation></message>
<message><source>{name} is {found}; write a list of numbers as in [1.0, 2.0]</source><translation>{name} ist {found}; eine Liste von Zahlen schreiben wie [1.0, 2.0]</translation></message>
<message><source>{name} is {found}; write a list of tables, each with decentre or tilt_deg</source><translation>{name} ist {found}; eine Liste von Tabellen schreiben, jede mit decentre oder tilt_deg</translation></message>
<message><source>{name} is {found}; write a square list of rows of numbers</source><translation>{name} ist {found}; eine quadratische Liste von Zeilen von Zahlen schreiben</translation></message>
<message><source>{name} is {found}; write a table [{name}] with its columns</source><translation>{name} ist {found}; eine Tabelle [{name}] mit ihren Spalten schreiben</translation></message>
<message><source>{name} is {found}; write a text in quotation marks</source><translation>{name} ist {found}; einen Text in Anführungszeichen schreiben</translation></message>
<message><source>{name} is {found}; write a whole number</source><translation>{name} ist {found}; eine ganze Zahl schreiben</translation></message>
<message><source>{name} is {found}; write one value for each of the {count} columns of {kind}</source><translation>{name} ist {found}; für jede der {count} Spalten von {kind} einen Wert schreiben</translation></message>
<message><source>{name} is {found}; write true or false</source><translation>{name} ist {found}; true oder false schreiben</translation></message>
<message><source>{name} is {found}; write {{ key = value, … }}</source><translation>{name} ist {found}; {{ key = value, … }} schreiben</translation></message>
<message><source>{name} is {found}; {remedy}</source><translation>{name} ist {found}; {remedy}</translation></message>
<message><source>{name} is {value}; give {kind}</source><translation>{name} ist {value}; {kind} angeben</translation></message>
<message><source>{name} is {value}; give {least} to {most} numbers, or none for those that the window chooses</source><translation>{name} ist {value}; {least} bis {most} Zahlen angeben, oder keine für die, die das Fenster wählt</translation></message>
<message><source>{name} is {value}; list some of {allowed}, each once and in this order</source><translation>{name} ist {value}; einige von {allowed} nennen, jedes einmal und in dieser Reihenfolge</translation></message>
<message><source>{name} sagittal</source><translation>{name} sagittal</translation></message>
<message><source>{name} tangential</source><translation>{name} tangential</translation></message>
<message><source>{name} third order</source><translation>{name} 3. Ordnung</translation></message>
<message><source>{name} uses dispersion formula {formula}; only 1 to 13 exist, correct it</source><translation>{name} benutzt die Dispersionsformel {formula}; es gibt nur 1 bis 13, berichtigen</translation></message>
<message><source>{name} varies with {kind}, of which there is no table; add [{kind}]</source><translation>{name} ändert sich mit {kind}, wofür es keine Tabelle gibt; [{kind}] ergänzen</translation></message>
<message><source>{name}: {likeness}</source><translation>{name}: {likeness}</translation></message>
<message><source>{nm:.1f} nm</source><translation>{nm:.1f} nm</translation></message>
<message><source>{nodes}, those that the rims let pass</source><translation>{nodes}, soweit die Ränder sie durchlassen</translation></message>
<message><source>{numbers} fitted numbers leave 1 − R² ≤ {error:.1e} only</source><translation>{numbers} angepasste Zahlen erreichen nur 1 − R² ≤ {error:.1e}</translation></message>
<message><source>{numbers} fitted numbers keep 1 − R² ≤ {error:.1e}, where {allowed:.1e} is allowed and six coefficients would leave more</source><translation>{numbers} angepasste Zahlen halten 1 − R² ≤ {error:.1e} ein, wo {allowed:.1e} erlaubt ist und sechs Koeffizienten mehr ließen</translation></message>
<message><source>{numbers} numbers, {rays} rays; sampling: {words}</source><translation>{numbers} Zahlen, {rays} Strahlen; Abtastung: {words}</translation></message>
<message><source>{off:.3g} mm from the middle of this picture, which was moved in to stay within the field of the lens</source><translation>{off:.3g} mm von der Mitte dieses Bilds, das nach innen gerückt wurde, um im Feld des Objektivs zu bleiben</translation></message>
<message><source>{others} and {last}</source><translation>{others} und {last}</translation></message>
<message><source>{page} (in English)</source><translation>{page} (englisch)</translation></message>
<message><source>{parameter} and {other} are both given; keep one of them</source><translation>{parameter} und {other} sind beide angegeben; eines davon behalten</translation></message>
<message><source>{parameter} fitted keeps more of them</source><translation>{parameter} fitted gibt sie getreuer wieder</translation></message>
<message><source>{parameter} has no number; give one or more</source><translation>{parameter} hat keine Zahl; eine oder mehrere angeben</translation></message>
<message><source>{parameter} has the shape {given}, and the PSFs {shape}; give one of that shape</source><translation>{parameter} hat die Form {given} und die PSFs {shape}; ein Feld dieser Form angeben</translation></message>
<message><source>{parameter} has the shape {shape} or contains values that are not finite; give one number or a list of numbers</source><translation>{parameter} hat die Form {shape} oder enthält etwas, das keine endliche Zahl ist; geben Sie eine Zahl oder eine Liste von Zahlen an</translation></message>
<message><source>{parameter} has {count} terms; give up to {most} numbers</source><translation>{parameter} hat {count} Terme; bis zu {most} Zahlen angeben</translation></message>
<message><source>{parameter} holds {kind}; give real numbers</source><translation>{parameter} enthält {kind}; geben Sie reelle Zahlen an</translation></message>
<message><source>{parameter} is "{value}"; choose file or auto</source><translation>{parameter} ist "{value}"; file oder auto wählen</translation></message>
<message><source>{parameter} is "{value}"; choose noll or fringe</source><translation>{parameter} ist "{value}"; noll oder fringe wählen</translation></message>
<message><source>{parameter} is "{value}"; choose stop or paraxial</source><translation>{parameter} ist "{value}"; stop oder paraxial wählen</translation></message>
<message><source>"{name}" is neither of a source nor of a camera; choose {choices}</source><translation>"{name}" gehört weder zu einer Quelle noch zu einer Kamera; {choices} wählen</translation></message>
<message><source>{parameter} is "{value}"; choose {choices}</source><translation>{parameter} ist "{value}"; {choices} wählen</translation></message>
<message><source>{parameter} is None; give a distance, inf for infinity</source><translation>{parameter} ist None; einen Abstand angeben, inf für unendlich</translation></message>
<message><source>{parameter} is None; give one number or a list of them for all points</source><translation>{parameter} ist None; geben Sie eine Zahl oder eine Liste von Zahlen für alle Punkte an</translation></message>
<message><source>{parameter} is for {method} fitted; leave it out</source><translation>{parameter} gilt für {method} fitted; weglassen</translation></message>
<message><source>{parameter} is given with {height}; give {angle} with it, or leave it out</source><translation>{parameter} ist mit {height} angegeben; dazu {angle} angeben oder es weglassen</translation></message>
<message><source>{parameter} is {path}; {wanted}, choose a name that ends in {ending}</source><translation>{parameter} ist {path}; {wanted}, einen Namen wählen, der auf {ending} endet</translation></message>
<message><source>{parameter} is {value:g} %; give 0 or more, 0 where the f-number is known exactly</source><translation>{parameter} ist {value:g} %; 0 oder mehr angeben, 0 bei genau bekannter Blendenzahl</translation></message>
<message><source>{parameter} is {value:g} about ({x:g}, {y:g}), which extends beyond the rim of the stop; make it smaller or move it towards the centre</source><translation>{parameter} ist {value:g} um ({x:g}, {y:g}) und reicht über den Rand der Blende hinaus; kleiner machen oder näher zur Mitte rücken</translation></message>
<message><source>{parameter} is {value:g} mm, but an object at infinity has no height; give {depth} as well, or the field as an angle or an image height</source><translation>{parameter} ist {value:g} mm, aber ein Objekt im Unendlichen hat keine Höhe; auch {depth} angeben oder das Feld als Winkel oder Bildhöhe</translation></message>
<message><source>{parameter} is {value:g} mm, but the image of that distance lies {where}, not on a sensor behind the lens; give a distance with a real image, usually a longer one</source><translation>{parameter}: {value:g} mm, aber das Bild dieses Abstands liegt {where} und nicht auf einem Sensor hinter dem Objektiv; einen Abstand angeben, dessen Bild reell ist, meist einen größeren</translation></message>
<message><source>{parameter} is {value:g} µm, which moves the sensor from {place:g} mm behind the lens into the lens; give a smaller shift</source><translation>{parameter} ist {value:g} µm, was den Sensor von {place:g} mm hinter dem Objektiv in dieses hinein schiebt; einen kleineren Versatz angeben</translation></message>
<message><source>{parameter} is {value:g}; give a number between 0 and 1</source><translation>{parameter} ist {value:g}; eine Zahl zwischen 0 und 1 angeben</translation></message>
<message><source>{parameter} is {value:g}; give a number from {low:g} to {high:g}</source><translation>{parameter} ist {value:g}; eine Zahl von {low:g} bis {high:g} angeben</translation></message>
<message><source>{parameter} is {value:g}; give a radius of at least {low:g}, inf for none</source><translation>{parameter} ist {value:g}; einen Radius von mindestens {low:g} angeben, inf für keine</translation></message>
<message><source>{parameter} is {value:g}; give the R² to hold, below 1</source><translation>{parameter} ist {value:g}; das einzuhaltende R² angeben, unter 1</translation></message>
<message><source>{parameter} is {value:g}; give the least peak signal-to-noise ratio, a positive number</source><translation>{parameter} ist {value:g}; das kleinste Spitzen-Signal-Rausch-Verhältnis angeben, eine positive Zahl</translation></message>
<message><source>{parameter} is {value:g}{unit}, which needs a chief ray at 90° to the axis; give a smaller one</source><translation>{parameter} ist {value:g}{unit}, wofür der Hauptstrahl 90° zur Achse stehen müsste; einen kleineren Wert angeben</translation></message>
<message><source>{parameter} is {value:g}{unit}; give a finite number</source><translation>{parameter}: {value:g}{unit}; eine endliche Zahl angeben</translation></message>
<message><source>{parameter} is {value:g}{unit}; give a positive finite number</source><translation>{parameter}: {value:g}{unit}; eine positive endliche Zahl angeben</translation></message>
<message><source>{parameter} is {value:g}{unit}, but rays from beyond {most:g} mm are in effect parallel; give inf</source><translation>{parameter}: {value:g}{unit}; über {most:g} mm hinaus sind Strahlen nicht von parallelen zu unterscheiden; ∞ angeben</translation></message>
<message><source>{parameter} of {value:g} is tighter than the relative error of {least:g} that polynomial pupils can promise; loosen it or render single PSFs with {method} huygens</source><translation>{parameter} von {value:g} ist enger als der relative Fehler {least:g}, den Polynompupillen versprechen können; es lockern oder einzelne PSFs mit {method} huygens rechnen</translation></message>
<message><source>{parameter} reaches {value:.4g} µm, and a wavefront on {size} cells repeats its PSF beyond {most:.4g} µm; give it on a finer grid</source><translation>{parameter} reicht bis {value:.4g} µm, und die PSF einer Wellenfront auf {size} Zellen wiederholt sich jenseits von {most:.4g} µm; sie auf einem feineren Gitter angeben</translation></message>
<message><source>{path} cannot be written ({why})</source><translation>{path} lässt sich nicht schreiben ({why})</translation></message>
<message><source>{percent:.1f} % of the rays that fill the pupil reach the sensor, too few for its contrast and energy; move the source to a distance the lens is made for, or stop the lens down</source><translation>{percent:.1f} % der Strahlen, die die Pupille füllen, erreichen den Sensor, zu wenige für Kontrast und Energie; die Quelle in einen Abstand bringen, für den das Objektiv gemacht ist, oder abblenden</translation></message>
<message><source>and so in half of its space</source><translation>und das im halben Raum</translation></message>
<message><source>median 1 − R² {median:.1e}</source><translation>Median von 1 − R² {median:.1e}</translation></message>
<message><source>PSFs of this database are predicted to be too far from those of exact rays {where} to say how far, {median}; {remedy}</source><translation>PSFs dieser Datenbank liegen {where} zu weit von denen exakter Strahlen, um zu sagen, wie weit, {median}; {remedy}</translation></message>
<message><source>biconic</source><translation>bikonische Fläche</translation></message>
<message><source>grating</source><translation>Gitter</translation></message>
<message><source>grating: {lines:g} lines per mm, order {order:g}, turned by {angle:z.6g}°</source><translation>Gitter: {lines:g} Linien je mm, Ordnung {order:g}, um {angle:z.6g}° gedreht</translation></message>
<message><source>predicted 1 − R² against exact rays: median {median:.1e}, up to {worst:.1e} {where}</source><translation>vorausgesagtes 1 − R² gegen exakte Strahlen: Median {median:.1e}, bis {worst:.1e} {where}</translation></message>
<message><source>predicted 1 − R² against exact rays: median {median:.1e}, too far from them to tell {where}</source><translation>vorausgesagtes 1 − R² gegen exakte Strahlen: Median {median:.1e}, {where} zu weit von ihnen für eine Zahl</translation></message>
<message><source>in half of this space PSFs are too far from exact rays to predict how far</source><translation>im halben Raum liegen die PSFs zu weit von exakten Strahlen, um zu sagen, wie weit</translation></message>
<message><source>is a grating in lines</source><translation>ist ein Liniengitter</translation></message>
<message><source>none: too far from exact rays to predict how far</source><translation>keine: zu weit von exakten Strahlen, um zu sagen, wie weit</translation></message>
<message><source>number of a grating</source><translation>Zahl eines Gitters</translation></message>
<message><source>number of a toroid or an anamorphic asphere</source><translation>Zahl einer torischen Fläche oder anamorphotischen Asphäre</translation></message>
<message><source>surface {surface} has a curvature, terms or diffraction beside its {kind}, for which the file has no line; save as TOML</source><translation>Fläche {surface} hat neben {kind} eine Krümmung, Glieder oder Beugung, für die die Datei keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} has a term in y^{power}, and a Zemax toroid holds powers up to y^{most}; save as TOML</source><translation>Fläche {surface} hat ein Glied in y^{power}, und eine torische Fläche von Zemax fasst Potenzen bis y^{most}; als TOML speichern</translation></message>
<message><source>surface {surface} has a term in y² or beyond y^{most}, for which a CODE V toroid has no line; save as TOML</source><translation>Fläche {surface} hat ein Glied in y² oder über y^{most} hinaus, für das eine torische Fläche von CODE V keine Zeile hat; als TOML speichern</translation></message>
<message><source>{parameter} is {value}; separate the numbers by semicolons, since a comma may belong to a number</source><translation>{parameter} ist {value}; Semikolons zwischen die Zahlen setzen, da ein Komma zu einer gehören kann</translation></message>
<message><source>the tolerance of {error} is {value:g}{unit}; give a number from 0 to {high:g}</source><translation>Toleranz für {error}: {value:g}{unit}; eine Zahl von 0 bis {high:g} angeben</translation></message>
<message><source>the point {where}: {error}</source><translation>der Punkt {where}: {error}</translation></message>
<message><source>{parameter} is {value:g}{unit}; give a positive number, inf allowed</source><translation>{parameter}: {value:g}{unit}; eine positive Zahl angeben, ∞ erlaubt</translation></message>
<message><source>{parameter} is {value:g}°, but no ray at 90° or more from the axis enters a lens; give an angle above −90° and below 90°</source><translation>{parameter} ist {value:g}°, und kein Strahl tritt bei 90° oder mehr zur Achse in ein Objektiv ein; einen Winkel zwischen −90 und 90° angeben, beide Enden ausgenommen</translation></message>
<message><source>{parameter} is {value}, but only depths may extend to inf; give a finite end</source><translation>{parameter} ist {value}, und nur Abstände reichen bis ∞; ein endliches Ende angeben</translation></message>
<message><source>{parameter} is {value}, but the lens has no such ring; leave it out</source><translation>{parameter} ist {value}, aber das Objektiv hat keinen solchen Ring; weglassen</translation></message>
<message><source>{parameter} is {value}, which does not ascend from a finite number; write LOW:HIGH:COUNT</source><translation>{parameter} ist {value}, was nicht von einer endlichen Zahl an aufsteigt; VON:BIS:ANZAHL schreiben</translation></message>
<message><source>{parameter} is {value}, which does not ascend; put the numbers in ascending order</source><translation>{parameter} ist {value}, was nicht aufsteigt; die Zahlen in aufsteigender Folge schreiben</translation></message>
<message><source>{parameter} is {value}, which is for {method} seidel; leave it out</source><translation>{parameter} ist {value}, was für {method} seidel gilt; weglassen</translation></message>
<message><source>{parameter} is {value}, whose COUNT is {count}; give from 2 to {most}</source><translation>{parameter} ist {value}, ANZAHL {count}; 2 bis {most} angeben</translation></message>
<message><source>{parameter} is {value}; give 0 for none, or a whole number from {low} to {high}</source><translation>{parameter} ist {value}; 0 für keine oder eine ganze Zahl von {low} bis {high} angeben</translation></message>
<message><source>{parameter} is {value}; give a number from {low:g} to {high:g}{unit}, or a column of the lens: {columns}</source><translation>{parameter} ist {value}; eine Zahl von {low:g} bis {high:g}{unit} angeben, oder eine Spalte des Objektivs: {columns}</translation></message>
<message><source>{parameter} is {value}; give a number without a unit, in {unit}</source><translation>{parameter} ist {value}; geben Sie eine Zahl ohne Einheit an, in {unit}</translation></message>
<message><source>{parameter} is {value}; give a whole number from {low} to {high}</source><translation>{parameter} ist {value}; eine ganze Zahl von {low} bis {high} angeben</translation></message>
<message><source>{parameter} is {value}; give a whole number of 1 or more</source><translation>{parameter} ist {value}; eine ganze Zahl ab 1 angeben</translation></message>
<message><source>{parameter} is {value}; give an even number from {low} to {high}</source><translation>{parameter} ist {value}; eine gerade Zahl von {low} bis {high} angeben</translation></message>
<message><source>{parameter} is {value}; give positive distances in front of the lens</source><translation>{parameter} ist {value}; Abstände vor dem Objektiv angeben, größer als 0</translation></message>
<message><source>{parameter} is {value}; give one angle in degrees, or two, x and y</source><translation>{parameter} ist {value}; einen Winkel in Grad angeben oder zwei, x und y</translation></message>
<message><source>{parameter} is {value}; give a tuple</source><translation>{parameter} ist {value}; geben Sie mehrere an, als Tupel</translation></message>
<message><source>{parameter} is {value}; give {wanted}</source><translation>{parameter} ist {value}; geben Sie {wanted} an</translation></message>
<message><source>{parameter} is {value}; write LOW:HIGH:COUNT, one number, or numbers with {separators}</source><translation>{parameter} ist {value}; VON:BIS:ANZAHL schreiben, eine Zahl, oder Zahlen mit {separators} dazwischen</translation></message>
<message><source>{parameter} reaches {value:.4g} µm, and this line spread is known up to {most:.4g} µm from its centroid; give positions within that</source><translation>{parameter} reicht bis {value:.4g} µm, und diese Linienbildfunktion ist bis {most:.4g} µm vom Schwerpunkt bekannt; geben Sie Orte innerhalb davon an</translation></message>
<message><source>{path} cannot be read ({why}); give a lesson as UTF-8 text</source><translation>{path} ist nicht lesbar ({why}); eine Lektion als UTF-8-Text angeben</translation></message>
<message><source>{path} cannot be read ({why}); give a state file that exists</source><translation>{path} ist nicht lesbar ({why}); eine Zustandsdatei angeben, die es gibt</translation></message>
<message><source>{path} cannot be read as a picture; it is damaged, or of another kind than its ending says</source><translation>{path} lässt sich nicht als Bild lesen; es ist beschädigt oder von anderer Art, als seine Endung sagt</translation></message>
<message><source>{path} cannot be read as text; check the name</source><translation>{path} lässt sich nicht als Text lesen; den Namen prüfen</translation></message>
<message><source>{path} cannot be read, {reason}; check the name</source><translation>{path} ist nicht lesbar, {reason}; den Namen prüfen</translation></message>
<message><source>{path} cannot be read, {reason}; give the path of a PNG, TIFF, OpenEXR, JPEG or HEIF</source><translation>{path} ist nicht lesbar, {reason}; den Pfad eines PNG, TIFF, OpenEXR, JPEG oder HEIF angeben</translation></message>
<message><source>{path} cannot be read, {reason}; give the path of a scene file</source><translation>{path} ist nicht lesbar, {reason}; den Pfad einer Szenendatei angeben</translation></message>
<message><source>{path} cannot be written, the draft beside it stayed empty; choose another disk</source><translation>{path} ist nicht schreibbar, der Entwurf daneben blieb leer; einen anderen Datenträger wählen</translation></message>
<message><source>{path} cannot be written, {reason}; choose a folder you may write to</source><translation>{path} ist nicht schreibbar, {reason}; einen Ordner wählen, in den Sie schreiben dürfen</translation></message>
<message><source>{path} cannot be written, {reason}; {remedy}</source><translation>{path} ist nicht schreibbar, {reason}; {remedy}</translation></message>
<message><source>{path} cannot be written, {why}; choose another place</source><translation>{path} ist nicht schreibbar, {why}; einen anderen Ort wählen</translation></message>
<message><source>{path} cannot be written; choose XDG_DATA_HOME otherwise</source><translation>{path} ist nicht beschreibbar; XDG_DATA_HOME anders wählen</translation></message>
<message><source>{path} does not state the size of its pixels; give {parameter}</source><translation>{path} sagt nicht, wie groß seine Pixel sind; {parameter} angeben</translation></message>
<message><source>{path} has a table of {rows} × {columns} values, and its head says {said}; list it again</source><translation>{path} hat eine Tabelle von {rows} × {columns} Werten, und ihr Kopf sagt {said}; sie neu ausgeben</translation></message>
<message><source>{path} has the ending "{ending}", which is not a picture format here; choose {choices}</source><translation>{path} hat die Endung "{ending}", was hier kein Bild ist; {choices} wählen</translation></message>
<message><source>{path} has the shape ({shape}); give one picture of 1 or 3 channels</source><translation>{path} hat die Form ({shape}); ein Bild mit 1 oder 3 Kanälen angeben</translation></message>
<message><source>{path} holds an array of shape {shape}; give rows and columns of counts</source><translation>{path} enthält ein Feld der Form {shape}; Zeilen und Spalten von Zählwerten angeben</translation></message>
<message><source>{path} holds {count} points of a target; at least {least} are needed</source><translation>{path} enthält {count} Punkte einer Zielkarte; nötig sind mindestens {least}</translation></message>
<message><source>{path} holds {kind} samples; save it with 8 or 16 bits or as float</source><translation>{path} enthält Werte vom Typ {kind}; mit 8 oder 16 Bit oder als Gleitkomma speichern</translation></message>
<message><source>{path} is a TIFF that cannot be read ({why}); save it again, uncompressed</source><translation>{path} ist ein TIFF, das nicht lesbar ist ({why}); noch einmal speichern, unkomprimiert</translation></message>
<message><source>{path} is a damaged {kind} ({why}); save the picture again</source><translation>{path} ist ein beschädigtes {kind} ({why}); das Bild neu speichern</translation></message>
<message><source>{path} is not a PNG, TIFF, OpenEXR, JPEG or HEIF that can be read; convert it to one</source><translation>{path} ist kein lesbares PNG, TIFF, OpenEXR, JPEG oder HEIF; in eines davon umwandeln</translation></message>
<message><source>{path} is not a PSF that this program wrote; export it again with p2sf psf -o</source><translation>{path} ist keine PSF, die dieses Programm geschrieben hat; mit p2sf psf -o neu ausgeben</translation></message>
<message><source>{path} is not a listing of a PSF or a wavefront map that can be read; write it as text from OpticStudio</source><translation>{path} ist keine lesbare Liste einer PSF oder einer Wellenfront; sie als Text aus OpticStudio schreiben</translation></message>
<message><source>{path} is not a measurement that this program wrote; make it with p2sf measure -o</source><translation>{path} ist keine Messung, die dieses Programm geschrieben hat; sie mit p2sf measure -o erstellen</translation></message>
<message><source>{path} is not on this computer; the saved state carries the lens itself</source><translation>{path} ist nicht auf diesem Rechner; der gespeicherte Zustand enthält das Objektiv selbst</translation></message>
<message><source>{path} is not valid TOML: {reason}; correct it</source><translation>{path} ist kein TOML: {reason}; berichtigen</translation></message>
<message><source>{path} is too large a {kind} ({why}); save it smaller</source><translation>{path} ist als {kind} zu groß ({why}); kleiner speichern</translation></message>
<message><source>{path} is too large: {reason}; cut it</source><translation>{path} ist zu groß: {reason}; zuschneiden</translation></message>
<message><source>{path} lists a wavefront, not a PSF; list the PSF of the same point</source><translation>{path} listet eine Wellenfront, keine PSF; die PSF desselben Punktes ausgeben</translation></message>
<message><source>{path}, line {line}: "{text}" is not a point of a target; give a whole number, x and y</source><translation>{path}, Zeile {line}: "{text}" ist kein Punkt einer Zielkarte; eine ganze Zahl, x und y angeben</translation></message>
<message><source>{path}, line {line}: name the columns first, number x_mm y_mm or number x_deg y_deg</source><translation>{path}, Zeile {line}: zuerst die Spalten nennen, number x_mm y_mm oder number x_deg y_deg</translation></message>
<message><source>{path}, line {line}: {message}</source><translation>{path}, Zeile {line}: {message}</translation></message>
<message><source>{path}, line {line}: {words} is number {other} once more; give each point one number and place</source><translation>{path}, Zeile {line}: {words} ist noch einmal Nummer {other}; jedem Punkt eine Nummer und einen Ort geben</translation></message>
<message><source>{path} has the channels {channels}; give one with R, G and B, or with Y or Z alone</source><translation>{path} hat die Kanäle {channels}; eines mit R, G und B angeben, oder mit Y oder Z allein</translation></message>
<message><source>{path}: OpenEXR files need its library, which is not installed; pip install 'p2sf[exr]', or use a TIFF of floats</source><translation>{path}: OpenEXR-Dateien brauchen dessen Bibliothek, die nicht installiert ist; pip install 'p2sf[exr]', oder ein TIFF mit Gleitkommazahlen</translation></message>
<message><source>{path}: HEIF photos need pillow-heif, which is not installed; pip install 'p2sf[heif]', or save a JPEG</source><translation>{path}: HEIF-Fotos brauchen pillow-heif, das nicht installiert ist; pip install 'p2sf[heif]', oder ein JPEG speichern</translation></message>
<message><source>{path}: numbers of 8 bits are taken for sRGB and made linear; if they are counts, {parameter} linear says so</source><translation>{path}: Zahlen von 8 Bit werden als sRGB gelesen und linear gemacht; sind es Zählwerte, so sagt das {parameter} linear</translation></message>
<message><source>{path}: PSF data has no ending "{ending}"; choose {endings}</source><translation>{path}: PSF-Daten haben nicht die Endung "{ending}"; {endings} wählen</translation></message>
<message><source>{path}: a film has no ending "{ending}"; choose {endings}</source><translation>{path}: ein Film hat nicht die Endung "{ending}"; {endings} wählen</translation></message>
<message><source>{path}: a picture of the window ends in ".png", not "{ending}"; change the ending</source><translation>{path}: ein Bild des Fensters endet auf ".png", nicht "{ending}"; die Endung ändern</translation></message>
<message><source>{path}: a value is missing or of the wrong kind ({reason}); numbers stand without quotes</source><translation>{path}: ein Wert fehlt oder ist von falscher Art ({reason}); Zahlen stehen ohne Anführungszeichen</translation></message>
<message><source>{path}: one file holds one PSF, this stack has shape ({shape}); write them singly</source><translation>{path}: eine Datei enthält eine PSF, dieser Stapel hat die Form ({shape}); einzeln schreiben</translation></message>
<message><source>{path}: the ending "{ending}" is not a picture format here; choose {choices}</source><translation>{path}: die Endung "{ending}" ist hier kein Bild; wählen: {choices}</translation></message>
<message><source>{path}: the ending "{ending}" is unknown; choose {choices}</source><translation>{path}: die Endung "{ending}" ist unbekannt; {choices} wählen</translation></message>
<message><source>{path}: this set-up has no PSF; change it until there is a picture</source><translation>{path}: diese Einstellung hat keine PSF; sie ändern, bis es ein Bild gibt</translation></message>
<message><source>{percent:.1f} %</source><translation>{percent:.1f} %</translation></message>
<message><source>{percent} % of the pupil</source><translation>{percent} % der Pupille</translation></message>
<message><source>{pitch} µm pixels</source><translation>{pitch}-µm-Pixel</translation></message>
<message><source>the light on {pixels} pixels of {pixel_um:g} µm takes more than {most} samples a side; give fewer or smaller pixels, or {parameter} False</source><translation>über {pixels} Pixel von {pixel_um:g} µm zu integrieren braucht mehr als {most} Abtastwerte je Seite; geben Sie weniger oder kleinere Pixel an, oder {parameter} False</translation></message>
<message><source>the order of the grating ({order:g}) turns rays towards +y where it is positive; see that it is meant so</source><translation>die Ordnung des Gitters ({order:g}) lenkt Strahlen nach +y, wenn sie positiv ist; prüfen, ob das so gemeint ist</translation></message>
<message><source>toroid</source><translation>torische Fläche</translation></message>
<message><source>{kind}: radii {x:g} mm in x and {y:g} mm in y, conic constants {conics:g}, turned by {angle:g}°</source><translation>{kind}: Radien {x:g} mm in x und {y:g} mm in y, konische Konstanten {conics:g}, um {angle:g}° gedreht</translation></message>
<message><source>{pixels} usable pixels for {unknowns} unknowns; take a larger window, or fit fewer numbers</source><translation>{pixels} brauchbare Pixel für {unknowns} Unbekannte; ein größeres Fenster nehmen oder weniger Zahlen anpassen</translation></message>
<message><source>{place:.6g} lies outside the pupils fitted from {low:.6g} to {high:.6g}; plan the scene again</source><translation>{place:.6g} liegt außerhalb der Pupillen, die von {low:.6g} bis {high:.6g} angepasst sind; die Szene neu planen</translation></message>
<message><source>{place:g} mm from the last vertex</source><translation>{place:g} mm vom letzten Scheitel</translation></message>
<message><source>{problem}; known are {columns}, A4, A6, …</source><translation>{problem}; bekannt sind {columns}, A4, A6, …</translation></message>
<message><source>{psnr:.1f} dB, SSIM {ssim:.3f}</source><translation>{psnr:.1f} dB, SSIM {ssim:.3f}</translation></message>
<message><source>{pupil_samples} pupil samples are too few for {pixels} PSF samples by FFT; give an even number of at least {least}</source><translation>{pupil_samples} Pupillenproben sind zu wenige für {pixels} PSF-Proben mit der FFT; eine gerade Zahl ab {least} angeben</translation></message>
<message><source>{quantity} differ between columns; they are those of the nearest, {near}</source><translation>{quantity} sind in den Spalten verschieden und sind die der nächsten, {near}</translation></message>
<message><source>{quantity} is {value}{unit}; give a number from {low:g} to {high:g}{unit}</source><translation>{quantity} ist {value}{unit}; eine Zahl von {low:g} bis {high:g}{unit} angeben</translation></message>
<message><source>{quantity} {wavelength:.7g} nm is outside the data of {glass}, {low:.7g} to {high:.7g} nm; choose a wavelength inside, or change the glass</source><translation>{quantity} {wavelength:.7g} nm liegt außerhalb der Daten von {glass}, {low:.7g} bis {high:.7g} nm; eine Wellenlänge darin wählen oder das Glas wechseln</translation></message>
<message><source>{quicker} while the slider moves, {method} when it rests</source><translation>{quicker}, solange der Regler sich bewegt, {method}, wenn er ruht</translation></message>
<message><source>{radial} radii × {angular} directions; give at least 1 radius and an even count ≥ 2</source><translation>{radial} Radien × {angular} Richtungen; mindestens 1 Radius und eine gerade Anzahl ≥ 2 angeben</translation></message>
<message><source>{radii} radii × {directions} directions</source><translation>{radii} Radien × {directions} Richtungen</translation></message>
<message><source>{rounds} rounds of Richardson–Lucy; give at least 1</source><translation>{rounds} Runden Richardson–Lucy; mindestens 1 angeben</translation></message>
<message><source>{rows} rows × {columns} columns; give even counts of at least 2</source><translation>{rows} Zeilen × {columns} Spalten; gerade Anzahlen ab 2 angeben</translation></message>
<message><source>{rows} × {columns} nodes</source><translation>{rows} × {columns} Knoten</translation></message>
<message><source>{rows} × {columns} places × {waves} wavelengths</source><translation>{rows} × {columns} Orte × {waves} Wellenlängen</translation></message>
<message><source>{rows} × {columns} places × {waves} wavelengths, mirror images at no cost</source><translation>{rows} × {columns} Orte × {waves} Wellenlängen, Spiegelbilder umsonst</translation></message>
<message><source>{r} λ left</source><translation>{r} λ Rest</translation></message>
<message><source>{r} λ with tilt</source><translation>{r} λ mit Verkippung</translation></message>
<message><source>{sampling}; the aligned lens, without its tilts, decentres and irregularities</source><translation>{sampling}; das Objektiv gerade gestellt, ohne seine Kippungen, Dezentrierungen und Passfehler</translation></message>
<message><source>{sampling}; {across:.3g} × {across:.3g} samples per pixel</source><translation>{sampling}; {across:.3g} × {across:.3g} Proben je Pixel</translation></message>
<message><source>{shading}, for which there are no six coefficients; choose the method fitted, traced or huygens, or leave {parameter} off</source><translation>{shading}, wofür es keine sechs Koeffizienten gibt; das Verfahren fitted, traced oder huygens wählen oder {parameter} aus lassen</translation></message>
<message><source>{shading}, which the paraxial pupil takes for even; aim at the stop</source><translation>{shading}, was die paraxiale Pupille für gleichmäßig nimmt; auf die Blende zielen</translation></message>
<message><source>{shape} samples at {pixel_um:g} µm</source><translation>{shape} Proben zu {pixel_um:g} µm</translation></message>
<message><source>{shape}, terms in y², y⁴, … {terms:.6g}</source><translation>{shape}, Glieder in y², y⁴, … {terms:.6g}</translation></message>
<message><source>{share} % ± {error} % keep {limit}</source><translation>{share} % ± {error} % halten {limit}</translation></message>
<message><source>{shift} µm over the spectrum</source><translation>{shift} µm über das Spektrum</translation></message>
<message><source>{size} × {size} cells</source><translation>{size} × {size} Zellen</translation></message>
<message><source>{surface} diffracts ({kind}) and not by a phase in powers of r²; only such phases are read</source><translation>{surface} beugt ({kind}), und nicht mit einer Phase in Potenzen von r²; nur solche Phasen werden gelesen</translation></message>
<message><source>{surface} diffracts by {command} {kind}, which is not read; only DOE with a phase in r (HCT R) is</source><translation>{surface} beugt durch {command} {kind}, was nicht gelesen wird; nur DOE mit einer Phase in r (HCT R) wird gelesen</translation></message>
<message><source>{surface} diffracts without a wavelength (HWL) of its phase; add it</source><translation>{surface} beugt ohne eine Wellenlänge (HWL) der Phase; ergänzen</translation></message>
<message><source>{surface} has Forbes's polynomials of type {kind:g}, which is neither Qbfs (0) nor Qcon (1); correct it</source><translation>{surface} hat Forbes-Polynome vom Typ {kind:g}, der weder Qbfs (0) noch Qcon (1) ist; berichtigen</translation></message>
<message><source>{surface} has Zernike terms on a shape that is not of revolution ({kind}), which is not read; leave them out</source><translation>{surface} hat Zernike-Glieder auf einer Form, die keine Rotationsfläche ist ({kind}), was nicht gelesen wird; sie weglassen</translation></message>
<message><source>{surface} has Zernike terms that are decentred, which is not read; centre them</source><translation>{surface} hat dezentrierte Zernike-Glieder, die nicht gelesen werden; sie zentrieren</translation></message>
<message><source>{surface} has a radius or a conic constant in x, but is neither YTO, XTO, CYL nor AAS; state which</source><translation>{surface} hat einen Radius oder eine konische Konstante in x, ist aber weder YTO, XTO, CYL noch AAS; angeben, welche</translation></message>
<message><source>{surface} has a shape ({kind}) that is not round or not known; only {known} are read</source><translation>{surface} hat eine Form ({kind}), die nicht rund oder nicht bekannt ist; nur {known} werden gelesen</translation></message>
<message><source>{surface} has an infinite thickness; give a finite one</source><translation>{surface} hat eine unendliche Dicke; eine endliche angeben</translation></message>
<message><source>{surface} has type {kind}, {description}; only the types {known} are read</source><translation>{surface} hat den Typ {kind}, {description}; nur die Typen {known} werden gelesen</translation></message>
<message><source>{surface} has {count:g} terms and a normalisation radius of {radius:g} in its extra data (XDAT); give up to {most} terms and a positive radius</source><translation>{surface} hat {count:g} Glieder und einen Normierungsradius von {radius:g} in den Zusatzdaten (XDAT); bis zu {most} Glieder und einen positiven Radius angeben</translation></message>
<message><source>{surface} is a grating without a spacing (GRS), or its planes are not parallel to the axis (GRZ); correct it</source><translation>{surface} ist ein Gitter ohne Abstand (GRS), oder seine Ebenen sind nicht parallel zur Achse (GRZ); berichtigen</translation></message>
<message><source>{surface} is a special surface of type {kind}, which is not read; {known} are</source><translation>{surface} ist eine Sonderfläche vom Typ {kind}, die nicht gelesen wird; gelesen werden {known}</translation></message>
<message><source>{surface} is tilted or decentred by its properties (SCBD); give coordinate breaks instead</source><translation>{surface} ist durch ihre Eigenschaften (SCBD) gekippt oder dezentriert; stattdessen Koordinatenbrüche angeben</translation></message>
<message><source>{surface} is tilted or decentred by {kind} about ({pivot:g}), which is not read; only {known} about the vertex are</source><translation>{surface} ist durch {kind} um ({pivot:g}) gekippt oder dezentriert, was nicht gelesen wird; nur {known} um den Scheitel werden gelesen</translation></message>
<message><source>{surface} {reason} ({command}), which is not read; give a lens without it</source><translation>{surface} {reason} ({command}), was nicht gelesen wird; ein Objektiv ohne das angeben</translation></message>
<message><source>{surface} {reason} ({command}); only centred systems are read</source><translation>{surface} {reason} ({command}); nur zentrierte Systeme werden gelesen</translation></message>
<message><source>{surface}: coefficient {name} of a special surface is not known; K, AR1 to AR30 and NRADIUS after SPS ODD are, and K, NRADIUS and the coefficients by their numbers after {known}</source><translation>{surface}: Koeffizient {name} einer Sonderfläche ist nicht bekannt; K, AR1 bis AR30 und NRADIUS nach SPS ODD sind es, und K, NRADIUS und die Koeffizienten mit ihren Nummern nach {known}</translation></message>
<message><source>{surface}: glass "{name}" is neither a name nor a six-digit code such as 517642 or 517.642; correct it</source><translation>{surface}: das Glas "{name}" ist weder ein Name noch ein sechsstelliger Code wie 517642 oder 517.642; berichtigen</translation></message>
<message><source>{surface}: radius {radius:g} differs from the lens data's; correct one</source><translation>{surface}: der Radius {radius:g} weicht von dem der Linsendaten ab; einen berichtigen</translation></message>
<message><source>{table} has "{key}", which means nothing here; it takes {keys}</source><translation>{table}: "{key}" bedeutet hier nichts; möglich sind {keys}</translation></message>
<message><source>{term} muted</source><translation>{term} stumm</translation></message>
<message><source>{term} solo</source><translation>{term} solo</translation></message>
<message><source>{there} of words, and the lesson has {count}; say each in its place</source><translation>{there} mit Worten, und die Lektion hat {count}; jeden an seiner Stelle sagen</translation></message>
<message><source>{used} of {all} points</source><translation>{used} von {all} Punkten</translation></message>
<message><source>{value:.1f} nm</source><translation>{value:.1f} nm</translation></message>
<message><source>{value:z.1f} µm</source><translation>{value:z.1f} µm</translation></message>
<message><source>{value:z.2f} µm</source><translation>{value:z.2f} µm</translation></message>
<message><source>{value:z.3f} mm</source><translation>{value:z.3f} mm</translation></message>
<message><source>{value:z.4f} mm</source><translation>{value:z.4f} mm</translation></message>
<message><source>{value} mm</source><translation>{value} mm</translation></message>
<message><source>{value} ± {error} λ</source><translation>{value} ± {error} λ</translation></message>
<message><source>{value} ± {error} λ ({own})</source><translation>{value} ± {error} λ ({own})</translation></message>
<message><source>{value} ± {error}{unit}</source><translation>{value} ± {error}{unit}</translation></message>
<message><source>{value} µm</source><translation>{value} µm</translation></message>
<message><source>{waves:.0f} nm</source><translation>{waves:.0f} nm</translation></message>
<message><source>{what} "{word}" is not a number; correct it</source><translation>{what} "{word}" ist keine Zahl; berichtigen</translation></message>
<message><source>{what} "{word}" is not a whole number; correct it</source><translation>{what} "{word}" ist keine ganze Zahl; berichtigen</translation></message>
<message><source>{where} has version {found}; this program reads versions up to {version:d}</source><translation>{where} hat Version {found}; dieses Programm liest Versionen bis {version:d}</translation></message>
<message><source>{where} is nested too deep or holds too long a number; save it again</source><translation>{where} ist zu tief verschachtelt oder enthält eine zu lange Zahl; neu speichern</translation></message>
<message><source>{where} is not a state of the explorer; give a .json the explorer has written</source><translation>{where} ist kein Zustand des Explorers; ein .json angeben, das der Explorer geschrieben hat</translation></message>
<message><source>{where}, line {line}: not JSON ({why}); correct it or save it again</source><translation>{where}, Zeile {line}: kein JSON ({why}); berichtigen oder neu speichern</translation></message>
<message><source>{where}: this is not the same in all columns, and {position} lies between them; put the ring on a column, marked ▾, to edit it there</source><translation>{where}: dies ist nicht in allen Spalten gleich, und {position} liegt dazwischen; den Ring auf eine Spalte stellen, mit ▾ bezeichnet, um es dort zu ändern</translation></message>
<message><source>{why}, so moving the sensor does not focus; set Wd by its slider, or reset the what-if</source><translation>{why}, also stellt ein anderer Ort des Sensors nicht scharf; Wd am Regler einstellen oder das Was-wäre-wenn zurücksetzen</translation></message>
<message><source>|f′| over the entrance pupil.</source><translation>|f′| durch die Eintrittspupille.</translation></message>
<message><source>± {percent} %</source><translation>± {percent} %</translation></message>
<message><source>±{half} µm depth of focus</source><translation>±{half} µm Fokustiefe</translation></message>
<message><source>× A | B</source><translation>× A | B</translation></message>
<message><source>× depths</source><translation>× Abstände</translation></message>
<message><source>× no coma</source><translation>× keine Koma</translation></message>
<message><source>× sensor shifts</source><translation>× Sensorversatz</translation></message>
<message><source>× wavelengths</source><translation>× Wellenlängen</translation></message>
<message><source>η, pupil radii (towards the field)</source><translation>η, Pupillenradien (zum Feld hin)</translation></message>
<message><source>η, stop radii (towards the field)</source><translation>η, Blendenradien (zum Feld hin)</translation></message>
<message><source>λ</source><translation>λ</translation></message>
<message><source>λ/2NA/{fineness:g}</source><translation>λ/2NA/{fineness:g}</translation></message>
<message><source>ξ, pupil radii</source><translation>ξ, Pupillenradien</translation></message>
<message><source>ξ, stop radii</source><translation>ξ, Blendenradien</translation></message>
<message><source>σx {sigma_x:.3g} µm, σy {sigma_y:.3g} µm, centre {centre:.3g} µm</source><translation>σx {sigma_x:.3g} µm, σy {sigma_y:.3g} µm, Mitte {centre:.3g} µm</translation></message>
<message><source>χ²</source><translation>χ²</translation></message>
<message><source>← → ↑ ↓, Page Up/Down</source><translation>← → ↑ ↓, Bild auf/ab</translation></message>
<message><source>∞</source><translation>∞</translation></message>
<message><source>⌀ {diameter} at {place:z.2f} mm</source><translation>⌀ {diameter} bei {place:z.2f} mm</translation></message>
<message><source>▶</source><translation>▶</translation></message>
<message><source>More controls</source><translation>Weitere Regler</translation></message>
<message><source>More or fewer controls</source><translation>Mehr oder weniger Regler</translation></message>
<message><source>▸ More controls</source><translation>▸ Weitere Regler</translation></message>
<message><source>▾ More controls</source><translation>▾ Weitere Regler</translation></message>
<message><source>Sensor shift, pupil shape, stop, rims, how rays fill the pupil, method and accuracy. What differs from the lens file, or from the usual method, is always shown.</source><translation>Sensorversatz, Pupillenform, Blende, Randbeschnitt, wie Strahlen die Pupille füllen, Methode und Genauigkeit. Was von der Objektivdatei oder der üblichen Methode abweicht, ist immer zu sehen.</translation></message>
<message><source>▸ Pupil shape</source><translation>▸ Pupillenform</translation></message>
<message><source>▾ Pupil shape</source><translation>▾ Pupillenform</translation></message>
<message><source>Copy as CSV</source><translation>Als CSV kopieren</translation></message>
<message><source>Copy the table with all its digits as CSV (Ctrl+Shift+D)</source><translation>Die Tabelle mit allen Ziffern als CSV kopieren (Strg+Umschalt+D)</translation></message>
<message><source>Performance</source><translation>Leistung</translation></message>
<message><source>Performance: figures over the field by exact rays. RMS: of the wavefront, without piston and tilt. S and T: sagittal and tangential contrast. R80: the radius that holds 80 % of the light. Illumination: relative to the middle of the field. Lateral colour: shortest less longest wavelength of the lens. Click a row to go to its field.</source><translation>Leistung: Zahlen über das Feld aus exakten Strahlen. RMS: der Wellenfront, ohne Konstante und Verkippung. S und T: sagittaler und tangentialer Kontrast. R80: Radius, der 80 % des Lichts enthält. Helligkeit: bezogen auf die Feldmitte. Farbquerfehler: kürzeste minus längste Wellenlänge des Objektivs. Ein Klick auf eine Zeile geht zu ihrem Feld.</translation></message>
<message><source>RMS</source><translation>RMS</translation></message>
<message><source>This is A: B has fields of its own, whose table is there with B on screen.</source><translation>Das ist A: B hat eigene Felder, deren Tabelle erscheint, wenn B zu sehen ist.</translation></message>
<message><source>illumination</source><translation>Helligkeit</translation></message>
<message><source>there is no field to compute; list at least one</source><translation>es ist kein Feld zu berechnen; mindestens eines angeben</translation></message>
<message><source>Overlays: one curve for each field, wavelength or spatial frequency. Contrast is tangential (thick) and sagittal (fine). Type any fields, or choose how many; wavelengths are those of Matrix. A vertical line marks the present point.</source><translation>Vergleichskurven: eine Kurve für jedes Feld, jede Wellenlänge oder Ortsfrequenz. Der Kontrast ist tangential (dick) und sagittal (fein). Felder eintippen oder ihre Zahl wählen; die Wellenlängen sind die der Matrix. Eine senkrechte Linie zeigt die jetzige Stelle.</translation></message>
<message><source>number of fields</source><translation>Zahl der Felder</translation></message>
<message><source>RMS wavefront</source><translation>RMS der Wellenfront</translation></message>
<message><source>Root mean square of the wavefront over the pupil, without piston and tilt, which do not blur.</source><translation>Effektivwert der Wellenfront über die Pupille, ohne Konstante und Verkippung, die nicht unscharf machen.</translation></message>
<message><source>a solve puts the paraxial focus {found:.7g} mm behind it; the file's thickness, {old:.7g} mm, is kept</source><translation>nach einer Lösevorschrift liegt der paraxiale Brennpunkt {found:.7g} mm dahinter; die Dicke der Datei, {old:.7g} mm, bleibt</translation></message>
<message><source>its thickness or curvature follows from others ({keyword}), and is here the same in all configurations</source><translation>ihre Dicke oder Krümmung folgt aus anderen ({keyword}) und ist hier in allen Konfigurationen dieselbe</translation></message>
<message><source>its thickness, up to the paraxial focus, is {found:.9g} mm</source><translation>ihre Dicke, bis zum paraxialen Brennpunkt, ist {found:.9g} mm</translation></message>
<message><source>number of a solve</source><translation>Zahl einer Lösevorschrift</translation></message>
<message><source>surface {surface} is the stop, with an obscuration beside a hole or a rim that is not a circle about the axis, for which CODE V has no line; save as TOML</source><translation>Fläche {surface} ist die Blende und hat neben der Abschattung ein Loch oder einen Rand, der kein Kreis um die Achse ist, wofür CODE V keine Zeile hat; als TOML speichern</translation></message>
<message><source>surface {surface} is the stop, with an obscuration beside a hole or a rim that is not a circle about the axis, for which Zemax has no line; save as TOML</source><translation>Fläche {surface} ist die Blende und hat neben der Abschattung ein Loch oder einen Rand, der kein Kreis um die Achse ist, wofür Zemax keine Zeile hat; als TOML speichern</translation></message>
<message><source>the tails of two different windows cannot be compared; compute both in one</source><translation>die Ausläufer zweier verschiedener Fenster lassen sich nicht vergleichen; beide in einem berechnen</translation></message>
<message><source>the middle of the stop is dark within a radius of {radius:g}, whatever rims do</source><translation>die Mitte der Blende ist innerhalb eines Radius von {radius:g} dunkel, was auch immer Ränder tun</translation></message>
<message><source>variables and solves, whose stored values are read</source><translation>Variable und Lösevorschriften, deren gespeicherte Werte gelesen werden</translation></message>
<message><source>variables, pickups and solves, whose stored values are read</source><translation>Variable, Übernahme- und Lösevorschriften, deren gespeicherte Werte gelesen werden</translation></message>
<message><source>MTF through focus: tangential solid, sagittal dashed</source><translation>MTF durch den Fokus: tangential durchgezogen, sagittal gestrichelt</translation></message>
<message><source>MTF: tangential solid, sagittal dashed</source><translation>MTF: tangential durchgezogen, sagittal gestrichelt</translation></message>
<message><source>Opens in P2SF Explorer: copy this link, then paste it into the window</source><translation>Öffnet sich im P2SF Explorer: diesen Link kopieren und ins Fenster einfügen</translation></message>
<message><source>PSF, {wide:.3g} µm wide, square root of brightness, each relative to its own peak</source><translation>PSF, {wide:.3g} µm breit, Wurzel der Helligkeit, jede auf ihre eigene Spitze bezogen</translation></message>
<message><source>Prescription</source><translation>Konstruktionsdaten</translation></message>
<message><source>Report as PDF (*.pdf);;Report as HTML (*.html);;Report as JSON (*.json)</source><translation>Bericht als PDF (*.pdf);;Bericht als HTML (*.html);;Bericht als JSON (*.json)</translation></message>
<message><source>Report as PDF, HTML or JSON…</source><translation>Bericht als PDF, HTML oder JSON …</translation></message>
<message><source>R80 {radius} µm (in view)</source><translation>R80 {radius} µm (im Bild)</translation></message>
<message><source>Spot diagrams</source><translation>Punktdiagramme</translation></message>
<message><source>Spot diagrams, ±{side:.3g} µm</source><translation>Punktdiagramme, ±{side:.3g} µm</translation></message>
<message><source>Writing the report</source><translation>Der Bericht wird geschrieben</translation></message>
<message><source>aspheric terms</source><translation>asphärische Terme</translation></message>
<message><source>conic</source><translation>Kegelschnitt</translation></message>
<message><source>focus, mm behind the sensor</source><translation>Fokus, mm hinter dem Sensor</translation></message>
<message><source>glass data</source><translation>Glasdaten</translation></message>
<message><source>medium</source><translation>Medium</translation></message>
<message><source>radius, mm</source><translation>Radius, mm</translation></message>
<message><source>semi-diameter, mm</source><translation>Halbmesser, mm</translation></message>
<message><source>the HTML report has the link, which is too long here</source><translation>der Link ist hier zu lang und steht im HTML-Bericht</translation></message>
<message><source>the file asks for telecentric object space, but the entrance pupil stands at {pupil:.6g} mm from the first surface; chief rays pass the centre of the stop instead</source><translation>die Datei verlangt einen telezentrischen Objektraum, aber die Eintrittspupille steht bei {pupil:.6g} mm von der ersten Fläche; Hauptstrahlen gehen stattdessen durch die Mitte der Blende</translation></message>
<message><source>the report was stopped</source><translation>der Bericht wurde abgebrochen</translation></message>
<message><source>thickness, mm</source><translation>Dicke, mm</translation></message>
<message><source>{depth}, field {field}, {wavelength:.1f} nm, {speed}</source><translation>{depth}, Feld {field}, {wavelength:.1f} nm, {speed}</translation></message>
<message><source>{parameter} is {path}, its ending "{ending}" is unknown; choose {endings}</source><translation>{parameter} ist {path}, die Endung "{ending}" ist unbekannt; wählen aus {endings}</translation></message>
<message><source>{surface} is a grating on a curved surface, whose lines are evenly spaced along the surface in ray-optics, and across the axis here; only plane gratings are read</source><translation>{surface} ist ein Gitter auf einer gekrümmten Fläche, dessen Linien bei ray-optics entlang der Fläche gleich weit auseinanderliegen, hier aber quer zur Achse; nur ebene Gitter werden gelesen</translation></message>
<message><source>parts of the lens are tilted, decentred or not of revolution; all paraxial figures and the six coefficients are those of the aligned lens, and leave out what that adds: coma on the axis, a tilted field</source><translation>Teile des Objektivs sind gekippt, dezentriert oder nicht rotationssymmetrisch; alle paraxialen Größen und die sechs Koeffizienten gelten für das justierte Objektiv und lassen aus, was dadurch hinzukommt: Koma auf der Achse, ein gekipptes Feld</translation></message>
<message><source>before surface {surface}: {words}</source><translation>vor Fläche {surface}: {words}</translation></message>
<message><source>behind surface {surface}: {words}</source><translation>hinter Fläche {surface}: {words}</translation></message>
<message><source>surface {surface}: {words}</source><translation>Fläche {surface}: {words}</translation></message>
<message><source>sensor: {words}</source><translation>Sensor: {words}</translation></message>
<message><source>aperture {kind} is {value:g}; give a number from {low:g} to {high:g}</source><translation>die Öffnung {kind} ist {value:g}; eine Zahl von {low:g} bis {high:g} angeben</translation></message>
<message><source>rays from all parts of the pupil arrive in one direction, along one axis at least, so that their light has no focus; move the object or refocus</source><translation>die Strahlen aller Teile der Pupille kommen, zumindest entlang einer Achse, aus einer Richtung an, sodass ihr Licht keinen Fokus hat; das Objekt verschieben oder neu fokussieren</translation></message>
<message><source>surface {surface} transmits no light; give a share above 0</source><translation>Fläche {surface} lässt kein Licht durch; einen Anteil über 0 angeben</translation></message>
<message><source>surface {surface}: thickness {thickness} mm; give a number from {low:g} to {high:g}</source><translation>Fläche {surface}: Dicke {thickness} mm; eine Zahl von {low:g} bis {high:g} angeben</translation></message>
<message><source>the line has over {count} letters; break it</source><translation>die Zeile hat über {count} Zeichen; sie umbrechen</translation></message>
<message><source>{reason}; this is not a lens file</source><translation>{reason}; das ist keine Objektivdatei</translation></message>
<message><source>{y} in y, {x} in x</source><translation>{y} in y, {x} in x</translation></message>
<message><source>a number is too long</source><translation>eine Zahl ist zu lang</translation></message>
<message><source>disk quota exceeded</source><translation>der zugeteilte Speicherplatz ist erschöpft</translation></message>
<message><source>file name too long</source><translation>der Dateiname ist zu lang</translation></message>
<message><source>file too large</source><translation>die Datei ist zu groß</translation></message>
<message><source>input/output error</source><translation>Ein- oder Ausgabefehler</translation></message>
<message><source>is a directory</source><translation>es ist ein Ordner</translation></message>
<message><source>it has more than {count:g} million bytes</source><translation>sie hat mehr als {count:g} Millionen Byte</translation></message>
<message><source>it is a pipe or a device and not a file</source><translation>es ist eine Pipe oder ein Gerät und keine Datei</translation></message>
<message><source>it is no text in UTF-8</source><translation>es ist kein Text in UTF-8</translation></message>
<message><source>its description is of another program</source><translation>ihre Beschreibung stammt von einem anderen Programm</translation></message>
<message><source>line {line} has a key of more than {most} parts</source><translation>Zeile {line} hat einen Schlüssel mit mehr als {most} Teilen</translation></message>
<message><source>lists or tables are nested too deep</source><translation>Listen oder Tabellen sind zu tief verschachtelt</translation></message>
<message><source>more than {most:.0f} MB beside the picture</source><translation>mehr als {most:.0f} MB neben dem Bild</translation></message>
<message><source>more than {most} parts</source><translation>mehr als {most} Teile</translation></message>
<message><source>more than {most} passes over its pixels</source><translation>mehr als {most} Durchgänge über seine Pixel</translation></message>
<message><source>no archive of arrays: {error}</source><translation>kein Archiv von Feldern: {error}</translation></message>
<message><source>no array of numbers</source><translation>kein Feld von Zahlen</translation></message>
<message><source>no picture within {most} parts</source><translation>kein Bild unter den ersten {most} Teilen</translation></message>
<message><source>no space left on device</source><translation>auf dem Datenträger ist kein Platz mehr</translation></message>
<message><source>no such file or directory</source><translation>es gibt keine solche Datei und keinen solchen Ordner</translation></message>
<message><source>not a directory</source><translation>es ist kein Ordner</translation></message>
<message><source>operation not permitted</source><translation>der Vorgang ist nicht erlaubt</translation></message>
<message><source>permission denied</source><translation>der Zugriff ist verweigert</translation></message>
<message><source>read-only file system</source><translation>das Dateisystem ist schreibgeschützt</translation></message>
<message><source>the file is write-protected</source><translation>die Datei ist schreibgeschützt</translation></message>
<message><source>too many levels of symbolic links</source><translation>zu viele symbolische Verknüpfungen hintereinander</translation></message>
<message><source>{count} letters of JSON, at most {most}</source><translation>{count} Zeichen JSON, höchstens {most}</translation></message>
<message><source>{count} members, at most {most}</source><translation>{count} Bestandteile, höchstens {most}</translation></message>
<message><source>{count} parts in {size} bytes</source><translation>{count} Teile in {size} Byte</translation></message>
<message><source>{declared:.0f} MB in {size} bytes, at most {most:.0f} MB</source><translation>{declared:.0f} MB in {size} Byte, höchstens {most:.0f} MB</translation></message>
<message><source>{shape} samples in {size} bytes, at most {side} on a side and {most:.0f} million in all</source><translation>{shape} Abtastwerte in {size} Byte, höchstens {side} auf einer Seite und {most:.0f} Millionen insgesamt</translation></message>
<message><source>more than {most:.0f} million pixels</source><translation>mehr als {most:.0f} Millionen Pixel</translation></message>
<message><source>there is no room for it in the folder of temporary files</source><translation>im Ordner für temporäre Dateien ist dafür kein Platz</translation></message>
</context>
</TS>
