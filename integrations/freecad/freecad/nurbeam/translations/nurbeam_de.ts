<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>App::Property</name>
    <message>
        <source>A beam or a sliding body; none: a point in space</source>
        <translation>Ein Balken oder ein Gleitkörper; keiner: ein Punkt im Raum</translation>
    </message>
    <message>
        <source>A closed sketch or a face</source>
        <translation>Eine geschlossene Skizze oder eine Fläche</translation>
    </message>
    <message>
        <source>A material card of the document, or one that FreeCAD brings</source>
        <translation>Eine Materialkarte des Dokuments, oder eine von FreeCAD</translation>
    </message>
    <message>
        <source>A plane face, a circle, a coordinate system, or an edge with one of its two points</source>
        <translation>Eine ebene Fläche, ein Kreis, ein Koordinatensystem, oder eine Kante mit einem ihrer beiden Punkte</translation>
    </message>
    <message>
        <source>A rigid curve on which bodies slide, without section and material</source>
        <translation>Eine starre Kurve, auf der Körper gleiten, ohne Querschnitt und Material</translation>
    </message>
    <message>
        <source>A solid that is shown at the body while results are looked at</source>
        <translation>Ein Volumenkörper, der am Gleitkörper gezeigt wird, solange Ergebnisse betrachtet werden</translation>
    </message>
    <message>
        <source>A straight edge or a plane face whose direction is taken instead</source>
        <translation>Eine gerade Kante oder ebene Fläche, deren Richtung stattdessen gilt</translation>
    </message>
    <message>
        <source>A vertex near which the beams meet; none: at an end of one of them</source>
        <translation>Ein Punkt, bei dem sich die Balken treffen; keiner: am Ende von einem</translation>
    </message>
    <message>
        <source>A vertex: the point in space, or the one whose nearest point of the beam is meant</source>
        <translation>Ein Punkt im Raum, oder der, dessen nächster Punkt des Balkens gemeint ist</translation>
    </message>
    <message>
        <source>A vertex; the nearest point of the beam is meant</source>
        <translation>Ein Punkt; gemeint ist der nächste Punkt des Balkens</translation>
    </message>
    <message>
        <source>Above that of the unstressed length; the material needs a thermal expansion</source>
        <translation>Über der Temperatur der spannungsfreien Länge; das Material braucht eine Wärmedehnung</translation>
    </message>
    <message>
        <source>Across the upright axis of the section</source>
        <translation>Quer zur Hochachse des Querschnitts</translation>
    </message>
    <message>
        <source>Additional moment, positive where it turns the second end back</source>
        <translation>Zusätzliches Moment, positiv, wo es das zweite Ende zurückdreht</translation>
    </message>
    <message>
        <source>All stored states (netCDF)</source>
        <translation>Alle gespeicherten Zustände (netCDF)</translation>
    </message>
    <message>
        <source>Along the upright axis of the section</source>
        <translation>Längs der Hochachse des Querschnitts</translation>
    </message>
    <message>
        <source>Angle since the drawing at which it is free</source>
        <translation>Winkel gegenüber der Zeichnung, bei dem sie entspannt ist</translation>
    </message>
    <message>
        <source>Area of all wires together</source>
        <translation>Fläche aller Drähte zusammen</translation>
    </message>
    <message>
        <source>Area of the section</source>
        <translation>Fläche des Querschnitts</translation>
    </message>
    <message>
        <source>Axial force in the reference configuration</source>
        <translation>Normalkraft in der Referenzlage</translation>
    </message>
    <message>
        <source>Axial stiffness EA</source>
        <translation>Dehnsteifigkeit EA</translation>
    </message>
    <message>
        <source>Axis about which the angle counts; 0 0 0: any turn is resisted</source>
        <translation>Achse, um die der Winkel zählt; 0 0 0: jede Drehung wird gehemmt</translation>
    </message>
    <message>
        <source>Beams that twist turn about this direction alone; 0 0 0: about all</source>
        <translation>Balken mit Torsion drehen nur um diese Richtung; 0 0 0: um alle</translation>
    </message>
    <message>
        <source>Bending stiffness EI</source>
        <translation>Biegesteifigkeit EI</translation>
    </message>
    <message>
        <source>Bodies that it stops; none: all on the beam</source>
        <translation>Körper, die er anhält; keiner: alle auf dem Balken</translation>
    </message>
    <message>
        <source>Cells of the table, the first row of which has the units: A1:D9</source>
        <translation>Zellen der Tabelle, mit den Einheiten in der ersten Zeile: A1:D9</translation>
    </message>
    <message>
        <source>Coefficient of sliding</source>
        <translation>Gleitreibungszahl</translation>
    </message>
    <message>
        <source>Coefficient of sticking; 0: that of sliding</source>
        <translation>Haftreibungszahl; 0: wie die Gleitreibungszahl</translation>
    </message>
    <message>
        <source>Density of the air that drags on bodies; 0: none</source>
        <translation>Dichte der Luft, die Körper bremst; 0: keine</translation>
    </message>
    <message>
        <source>Direction in which the support is free; of any length</source>
        <translation>Richtung, in der das Lager frei ist; von beliebiger Länge</translation>
    </message>
    <message>
        <source>Direction of gravity; 0 0 0: no weight</source>
        <translation>Richtung der Schwerkraft; 0 0 0: kein Gewicht</translation>
    </message>
    <message>
        <source>Direction of gravity; of any length</source>
        <translation>Richtung der Schwerkraft; von beliebiger Länge</translation>
    </message>
    <message>
        <source>Direction of the load; of any length</source>
        <translation>Richtung der Last; von beliebiger Länge</translation>
    </message>
    <message>
        <source>Direction of the upright axis of the section</source>
        <translation>Richtung der Hochachse des Querschnitts</translation>
    </message>
    <message>
        <source>Direction of the upright axis; of any length</source>
        <translation>Richtung der Hochachse; von beliebiger Länge</translation>
    </message>
    <message>
        <source>Drag coefficient times area</source>
        <translation>Widerstandsbeiwert mal Fläche</translation>
    </message>
    <message>
        <source>Edges, wires or sketches that meet end to end; of a solid pipe its centre line</source>
        <translation>Kanten, Linienzüge oder Skizzen, die aneinander anschließen; von einem Rohr die Mittellinie</translation>
    </message>
    <message>
        <source>End of a motion</source>
        <translation>Ende der Bewegung</translation>
    </message>
    <message>
        <source>Error of positions in equilibrium over the length of the beam</source>
        <translation>Fehler der Lage im Gleichgewicht, bezogen auf die Länge des Balkens</translation>
    </message>
    <message>
        <source>Excess of the length over the distance of the ends, in percent</source>
        <translation>Überlänge gegenüber dem Abstand der Enden, in Prozent</translation>
    </message>
    <message>
        <source>Exchanges start and end</source>
        <translation>Vertauscht Anfang und Ende</translation>
    </message>
    <message>
        <source>Factor on displacements</source>
        <translation>Faktor auf die Verschiebungen</translation>
    </message>
    <message>
        <source>Folder of the results; empty: a temporary one</source>
        <translation>Ordner der Ergebnisse; leer: ein vorübergehender</translation>
    </message>
    <message>
        <source>Force along the direction, as of a weight over a pulley</source>
        <translation>Kraft längs der Richtung, wie von einem Gewicht über eine Rolle</translation>
    </message>
    <message>
        <source>Force and moment act at a position, the others along the whole beam</source>
        <translation>Kraft und Moment wirken an einer Stelle, die anderen längs des ganzen Balkens</translation>
    </message>
    <message>
        <source>Force at the start, positive where it pulls</source>
        <translation>Kraft am Anfang, positiv, wo sie zieht</translation>
    </message>
    <message>
        <source>Force over how far the buffer is pressed in</source>
        <translation>Kraft je Eindrückung des Puffers</translation>
    </message>
    <message>
        <source>Force over the speed at which it is pressed in</source>
        <translation>Kraft je Geschwindigkeit der Eindrückung</translation>
    </message>
    <message>
        <source>Force per speed of the stretch</source>
        <translation>Kraft je Geschwindigkeit der Verlängerung</translation>
    </message>
    <message>
        <source>Force per stretch</source>
        <translation>Kraft je Verlängerung</translation>
    </message>
    <message>
        <source>From where bodies come that it stops</source>
        <translation>Von wo Körper kommen, die er anhält</translation>
    </message>
    <message>
        <source>Hard, or a buffer that gives way</source>
        <translation>Hart, oder ein Puffer, der nachgibt</translation>
    </message>
    <message>
        <source>How beams are shown</source>
        <translation>Wie Balken gezeigt werden</translation>
    </message>
    <message>
        <source>How the last run has ended</source>
        <translation>Wie der letzte Lauf endete</translation>
    </message>
    <message>
        <source>How the position on the beam is given</source>
        <translation>Wie die Stelle auf dem Balken angegeben ist</translation>
    </message>
    <message>
        <source>How the section is given</source>
        <translation>Wie der Querschnitt angegeben ist</translation>
    </message>
    <message>
        <source>Inertia of that weight</source>
        <translation>Masse dieses Gewichts</translation>
    </message>
    <message>
        <source>Inner radius</source>
        <translation>Innenradius</translation>
    </message>
    <message>
        <source>Inner radius of the solid</source>
        <translation>Innenradius des Volumenkörpers</translation>
    </message>
    <message>
        <source>It acts along this direction alone; 0 0 0: along itself</source>
        <translation>Wirkt nur längs dieser Richtung; 0 0 0: längs sich selbst</translation>
    </message>
    <message>
        <source>JSON, merged over the keys that this object writes into the case</source>
        <translation>JSON, über die Schlüssel gelegt, die dieses Objekt in die Falldatei schreibt</translation>
    </message>
    <message>
        <source>Keeps its two bodies apart, and stands at no position</source>
        <translation>Hält seine zwei Körper auseinander, und steht an keiner Stelle</translation>
    </message>
    <message>
        <source>Kind of analysis</source>
        <translation>Art der Berechnung</translation>
    </message>
    <message>
        <source>Kind of connector</source>
        <translation>Art der Verbindung</translation>
    </message>
    <message>
        <source>Kind of object, by which the workbench finds it</source>
        <translation>Art des Objekts, an der der Arbeitsbereich es erkennt</translation>
    </message>
    <message>
        <source>Length along the axis from the start of the beam</source>
        <translation>Länge längs der Achse ab dem Anfang des Balkens</translation>
    </message>
    <message>
        <source>Length of the axis</source>
        <translation>Länge der Achse</translation>
    </message>
    <message>
        <source>Length of the steps of a motion; 0: adaptive, by the tolerance</source>
        <translation>Länge der Zeitschritte; 0: angepasst, nach der Toleranz</translation>
    </message>
    <message>
        <source>Length without force</source>
        <translation>Länge ohne Kraft</translation>
    </message>
    <message>
        <source>Length without stress</source>
        <translation>Länge ohne Spannung</translation>
    </message>
    <message>
        <source>Local error of adaptive steps</source>
        <translation>Lokaler Fehler angepasster Schritte</translation>
    </message>
    <message>
        <source>Magnitude</source>
        <translation>Betrag</translation>
    </message>
    <message>
        <source>Magnitude of gravity</source>
        <translation>Betrag der Schwerkraft</translation>
    </message>
    <message>
        <source>Makes a solid of that diameter, instead of the axis alone</source>
        <translation>Erzeugt einen Volumenkörper dieses Durchmessers, statt nur die Achse</translation>
    </message>
    <message>
        <source>Mass of a clamp there</source>
        <translation>Masse einer Klemme dort</translation>
    </message>
    <message>
        <source>Mass of each metre</source>
        <translation>Masse je Meter</translation>
    </message>
    <message>
        <source>Mass of the body</source>
        <translation>Masse des Körpers</translation>
    </message>
    <message>
        <source>Maximum distance of the section from its axis of bending; 0: no stress is computed</source>
        <translation>Größter Abstand des Querschnitts von seiner Biegeachse; 0: ohne Spannung</translation>
    </message>
    <message>
        <source>Maximum number of threads; 0: one a core</source>
        <translation>Größte Zahl der Threads; 0: einer je Kern</translation>
    </message>
    <message>
        <source>Maximum tension</source>
        <translation>Größte Zugkraft</translation>
    </message>
    <message>
        <source>Minimum bend radius: EI over the maximum moment</source>
        <translation>Kleinster Biegeradius: EI durch das größte Moment</translation>
    </message>
    <message>
        <source>Minimum bend radius; the shortest length that respects it is found</source>
        <translation>Kleinster Biegeradius; gesucht wird die kürzeste Länge, die ihn einhält</translation>
    </message>
    <message>
        <source>Minimum distance of the two bodies along the beam</source>
        <translation>Kleinster Abstand der zwei Körper längs des Balkens</translation>
    </message>
    <message>
        <source>Moment of inertia about the beam, of a body that rolls with a beam that twists</source>
        <translation>Trägheitsmoment um den Balken, von einem Körper, der mit einem tordierten Balken rollt</translation>
    </message>
    <message>
        <source>Moment per angle</source>
        <translation>Moment je Winkel</translation>
    </message>
    <message>
        <source>Moment per speed of the angle</source>
        <translation>Moment je Winkelgeschwindigkeit</translation>
    </message>
    <message>
        <source>Number of elements; 0: as many as the tolerance needs</source>
        <translation>Zahl der Elemente; 0: so viele, wie die Toleranz braucht</translation>
    </message>
    <message>
        <source>Number of equal parts in which the loads are applied; 0: at once</source>
        <translation>Zahl gleicher Teile, in denen die Lasten aufgebracht werden; 0: auf einmal</translation>
    </message>
    <message>
        <source>Number of modes or buckling loads</source>
        <translation>Zahl der Eigenformen oder Knicklasten</translation>
    </message>
    <message>
        <source>Number of wires, each of which bends by itself; 0: 114</source>
        <translation>Zahl der Drähte, von denen sich jeder für sich biegt; 0: 114</translation>
    </message>
    <message>
        <source>Of the properties</source>
        <translation>Der Eigenschaften</translation>
    </message>
    <message>
        <source>Of the rope over all</source>
        <translation>Des ganzen Seils</translation>
    </message>
    <message>
        <source>Of the run</source>
        <translation>Des Laufs</translation>
    </message>
    <message>
        <source>Of the stored states</source>
        <translation>Der gespeicherten Zustände</translation>
    </message>
    <message>
        <source>Outer diameter of the cable</source>
        <translation>Außendurchmesser des Kabels</translation>
    </message>
    <message>
        <source>Outer radius</source>
        <translation>Außenradius</translation>
    </message>
    <message>
        <source>Outer radius of the solid</source>
        <translation>Außenradius des Volumenkörpers</translation>
    </message>
    <message>
        <source>Part of the length of the axis, from 0 to 1</source>
        <translation>Teil der Länge der Achse, von 0 bis 1</translation>
    </message>
    <message>
        <source>Resisting force, whatever presses on the beam</source>
        <translation>Bremskraft, was auch auf den Balken drückt</translation>
    </message>
    <message>
        <source>Rigid: the angle between the beams stays</source>
        <translation>Biegesteif: der Winkel zwischen den Balken bleibt</translation>
    </message>
    <message>
        <source>Second moment of area</source>
        <translation>Flächenträgheitsmoment</translation>
    </message>
    <message>
        <source>Second moment of area about the upright axis; 0: as the other</source>
        <translation>Flächenträgheitsmoment um die Hochachse; 0: wie das andere</translation>
    </message>
    <message>
        <source>Shape of the beam without stress</source>
        <translation>Form des Balkens ohne Spannung</translation>
    </message>
    <message>
        <source>Speed after an impact over the speed before</source>
        <translation>Geschwindigkeit nach einem Stoß durch die davor</translation>
    </message>
    <message>
        <source>Speed at the start, along the beam</source>
        <translation>Geschwindigkeit am Anfang, längs des Balkens</translation>
    </message>
    <message>
        <source>Speed of the air</source>
        <translation>Geschwindigkeit der Luft</translation>
    </message>
    <message>
        <source>Spreadsheet with rows over time</source>
        <translation>Tabelle mit Zeilen über der Zeit</translation>
    </message>
    <message>
        <source>St Venant&apos;s torsion constant; 0: that of a round section</source>
        <translation>Torsionsträgheitsmoment nach St. Venant; 0: das eines runden Querschnitts</translation>
    </message>
    <message>
        <source>State at time 0</source>
        <translation>Zustand zur Zeit 0</translation>
    </message>
    <message>
        <source>State of the last run</source>
        <translation>Zustand des letzten Laufs</translation>
    </message>
    <message>
        <source>The axis alone, or a solid with a round section</source>
        <translation>Nur die Achse, oder ein Volumenkörper mit rundem Querschnitt</translation>
    </message>
    <message>
        <source>The beam on which it stands</source>
        <translation>Der Balken, auf dem es steht</translation>
    </message>
    <message>
        <source>The beam, by its name in the case</source>
        <translation>Der Balken, mit seinem Namen in der Falldatei</translation>
    </message>
    <message>
        <source>The cable leaves the other way</source>
        <translation>Das Kabel geht andersherum ab</translation>
    </message>
    <message>
        <source>The case that was run</source>
        <translation>Die Falldatei, die gerechnet wurde</translation>
    </message>
    <message>
        <source>The load turns with the section</source>
        <translation>Die Last dreht sich mit dem Querschnitt</translation>
    </message>
    <message>
        <source>The position in space</source>
        <translation>Die Lage im Raum</translation>
    </message>
    <message>
        <source>The quantity that colours show</source>
        <translation>Die Größe, die Farben zeigen</translation>
    </message>
    <message>
        <source>The result that it is taken of</source>
        <translation>Das Ergebnis, aus dem sie stammt</translation>
    </message>
    <message>
        <source>The section of a beam that twists turns about this direction alone; 0 0 0: about all</source>
        <translation>Der Querschnitt eines Balkens mit Torsion dreht nur um diese Richtung; 0 0 0: um alle</translation>
    </message>
    <message>
        <source>The state that is shown, counted from 0</source>
        <translation>Der gezeigte Zustand, von 0 an gezählt</translation>
    </message>
    <message>
        <source>Thickness of the flanges</source>
        <translation>Dicke der Flansche</translation>
    </message>
    <message>
        <source>Thickness of the web</source>
        <translation>Dicke des Stegs</translation>
    </message>
    <message>
        <source>Time between stored states; 0: a hundredth of the end time</source>
        <translation>Zeit zwischen gespeicherten Zuständen; 0: ein Hundertstel der Endzeit</translation>
    </message>
    <message>
        <source>Time of the shape; the nearest stored state is taken</source>
        <translation>Zeit der Form; es gilt der nächste gespeicherte Zustand</translation>
    </message>
    <message>
        <source>Time until which the body is locked; 0: free from the start</source>
        <translation>Zeit, bis zu der der Körper festgehalten ist; 0: frei von Anfang an</translation>
    </message>
    <message>
        <source>Torque about the axis, for each metre</source>
        <translation>Torsionsmoment um die Achse, je Meter</translation>
    </message>
    <message>
        <source>Treatment of a corner of the axis</source>
        <translation>Behandlung einer Ecke der Achse</translation>
    </message>
    <message>
        <source>Two or more beams that meet</source>
        <translation>Zwei oder mehr Balken, die sich treffen</translation>
    </message>
    <message>
        <source>What happened during the run</source>
        <translation>Was während des Laufs geschah</translation>
    </message>
    <message>
        <source>What happens at the end of the beam</source>
        <translation>Was am Ende des Balkens geschieht</translation>
    </message>
    <message>
        <source>What is known of its free length</source>
        <translation>Was von der entspannten Länge bekannt ist</translation>
    </message>
    <message>
        <source>What is known of the length</source>
        <translation>Was von der Länge bekannt ist</translation>
    </message>
    <message>
        <source>What it holds: position and direction; position; position and roll; position but for one direction</source>
        <translation>Was es hält: Lage und Richtung; Lage; Lage und Verdrehung; Lage bis auf eine Richtung</translation>
    </message>
    <message>
        <source>Where forces jump: of the part before or after the position</source>
        <translation>Wo Kräfte springen: vom Teil vor oder nach der Stelle</translation>
    </message>
    <message>
        <source>Where the wind blows to; of any length</source>
        <translation>Wohin der Wind weht; von beliebiger Länge</translation>
    </message>
    <message>
        <source>Whether the beam may have a slope discontinuity there</source>
        <translation>Ob der Balken dort einen Knick haben darf</translation>
    </message>
    <message>
        <source>Whether the beam twists</source>
        <translation>Ob der Balken tordiert</translation>
    </message>
    <message>
        <source>Whether the end of a closed axis is joined to its start</source>
        <translation>Ob das Ende einer geschlossenen Achse mit ihrem Anfang verbunden ist</translation>
    </message>
    <message>
        <source>Whether the next recompute may take its time</source>
        <translation>Ob die nächste Neuberechnung länger dauern darf</translation>
    </message>
    <message>
        <source>Whose result it is</source>
        <translation>Wessen Ergebnis es ist</translation>
    </message>
</context>
<context>
    <name>NurbeamPreferences</name>
    <message>
        <source>Programs</source>
        <translation>Programme</translation>
    </message>
    <message>
        <source>Command nurbeam</source>
        <translation>Befehl nurbeam</translation>
    </message>
    <message>
        <source>Empty: the one in PATH</source>
        <translation>Leer: der in PATH</translation>
    </message>
    <message>
        <source>Folder of the Python module</source>
        <translation>Ordner des Python-Moduls</translation>
    </message>
    <message>
        <source>Empty: that of the installed package</source>
        <translation>Leer: der des installierten Pakets</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Analysis</name>
    <message>
        <source>A new analysis: it holds the parts of a model and says what is asked of it</source>
        <translation>Eine neue Berechnung: sie enthält die Teile eines Modells und sagt, was gefragt ist</translation>
    </message>
    <message>
        <source>Analysis</source>
        <translation>Berechnung</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Beam</name>
    <message>
        <source>A beam along the selected edges, wire or sketch, or of a selected pipe</source>
        <translation>Ein Balken längs der gewählten Kanten, des Linienzugs oder der Skizze, oder aus einem gewählten Rohr</translation>
    </message>
    <message>
        <source>Beam</source>
        <translation>Balken</translation>
    </message>
</context>
<context>
    <name>Nurbeam_CableOfLength</name>
    <message>
        <source>A cable between two selected faces, circles, coordinate systems or ends of edges, of a given length, slack or bend radius</source>
        <translation>Ein Kabel zwischen zwei gewählten Flächen, Kreisen, Koordinatensystemen oder Enden von Kanten, mit gegebener Länge, Überlänge oder Biegeradius</translation>
    </message>
    <message>
        <source>Cable of given length</source>
        <translation>Kabel gegebener Länge</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Check</name>
    <message>
        <source>Check</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>What is wrong with the model, each thing at its object</source>
        <translation>Was am Modell falsch ist, jeweils an seinem Objekt</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Connector</name>
    <message>
        <source>A spring, rope or rod between beams, bodies and points</source>
        <translation>Eine Feder, ein Seil oder ein Stab zwischen Balken, Körpern und Punkten</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Verbindung</translation>
    </message>
</context>
<context>
    <name>Nurbeam_ExportCase</name>
    <message>
        <source>Export case</source>
        <translation>Falldatei exportieren</translation>
    </message>
    <message>
        <source>Writes the case file of the active analysis, which runs on the command line with the same results</source>
        <translation>Schreibt die Falldatei der aktiven Berechnung, die auf der Befehlszeile dieselben Ergebnisse gibt</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Joint</name>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>What ties the selected beams, which meet</source>
        <translation>Was die gewählten Balken verbindet, die sich treffen</translation>
    </message>
</context>
<context>
    <name>Nurbeam_KeepFrame</name>
    <message>
        <source>Keep this frame</source>
        <translation>Dieses Bild behalten</translation>
    </message>
    <message>
        <source>The beams at the present frame as shapes that stay</source>
        <translation>Die Balken im gezeigten Zustand als bleibende Formen</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Load</name>
    <message>
        <source>A force or a moment on a beam, at a place or along it</source>
        <translation>Eine Kraft oder ein Moment auf einem Balken, an einer Stelle oder längs von ihm</translation>
    </message>
    <message>
        <source>Load</source>
        <translation>Last</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Material</name>
    <message>
        <source>A material card for the selected beams, or for all of the active analysis</source>
        <translation>Eine Materialkarte für die gewählten Balken, oder für alle der aktiven Berechnung</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>Material</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Plot</name>
    <message>
        <source>Plot energies</source>
        <translation>Energien zeichnen</translation>
    </message>
    <message>
        <source>The energy over time; other histories are in the panel of the results</source>
        <translation>Die Energie über der Zeit; andere Verläufe stehen bei den Ergebnissen</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Probe</name>
    <message>
        <source>A place of a beam whose motion is stored</source>
        <translation>Eine Stelle eines Balkens, deren Bewegung gespeichert wird</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Messpunkt</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Results</name>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>The motion of the active analysis, with colours and plots</source>
        <translation>Die Bewegung der aktiven Berechnung, mit Farben und Kurven</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Run</name>
    <message>
        <source>Run</source>
        <translation>Rechnen</translation>
    </message>
    <message>
        <source>Runs the active analysis in a process of its own</source>
        <translation>Rechnet die aktive Berechnung in einem eigenen Prozess</translation>
    </message>
</context>
<context>
    <name>Nurbeam_SlidingBody</name>
    <message>
        <source>A body that slides on a beam</source>
        <translation>Ein Körper, der auf einem Balken gleitet</translation>
    </message>
    <message>
        <source>Sliding body</source>
        <translation>Gleitkörper</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Stop</name>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>What sliding bodies come up against</source>
        <translation>Woran Gleitkörper anschlagen</translation>
    </message>
</context>
<context>
    <name>Nurbeam_Support</name>
    <message>
        <source>Support</source>
        <translation>Lager</translation>
    </message>
    <message>
        <source>What holds a place of a beam</source>
        <translation>Was eine Stelle eines Balkens hält</translation>
    </message>
</context>
<context>
    <name>Nurbeam_TakeOverFem</name>
    <message>
        <source>Beams, supports, forces and material of a FEM analysis of the document</source>
        <translation>Balken, Lager, Kräfte und Material einer FEM-Analyse des Dokuments</translation>
    </message>
    <message>
        <source>Take over FEM analysis</source>
        <translation>FEM-Analyse übernehmen</translation>
    </message>
</context>
<context>
    <name>Workbench</name>
    <message>
        <source>nurbeam</source>
        <translation>nurbeam</translation>
    </message>
    <message>
        <source>nurbeam cable</source>
        <translation>nurbeam Kabel</translation>
    </message>
    <message>
        <source>nurbeam model</source>
        <translation>nurbeam Modell</translation>
    </message>
    <message>
        <source>nurbeam results</source>
        <translation>nurbeam Ergebnisse</translation>
    </message>
    <message>
        <source>nurbeam solve</source>
        <translation>nurbeam Rechnen</translation>
    </message>
</context>
<context>
    <name>nurbeam</name>
    <message>
        <source>(none)</source>
        <translation>(keines)</translation>
    </message>
    <message>
        <source>About the upright axis</source>
        <translation>Um die Hochachse</translation>
    </message>
    <message>
        <source>Accuracy</source>
        <translation>Genauigkeit</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Danach</translation>
    </message>
    <message>
        <source>Air density</source>
        <translation>Luftdichte</translation>
    </message>
    <message>
        <source>Along edge or face</source>
        <translation>Längs Kante oder Fläche</translation>
    </message>
    <message>
        <source>Analysis</source>
        <translation>Berechnung</translation>
    </message>
    <message>
        <source>Analysis type</source>
        <translation>Art der Berechnung</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>As drawn</source>
        <translation>Wie gezeichnet</translation>
    </message>
    <message>
        <source>As drawn without torsion</source>
        <translation>Wie gezeichnet ohne Torsion</translation>
    </message>
    <message>
        <source>At a point</source>
        <translation>An einem Punkt</translation>
    </message>
    <message>
        <source>At end</source>
        <translation>Am Ende</translation>
    </message>
    <message>
        <source>At the start</source>
        <translation>Am Anfang</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Axial force</source>
        <translation>Normalkraft</translation>
    </message>
    <message>
        <source>Axial stiffness</source>
        <translation>Dehnsteifigkeit</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Beam</source>
        <translation>Balken</translation>
    </message>
    <message>
        <source>Beam name</source>
        <translation>Name des Balkens</translation>
    </message>
    <message>
        <source>Beams</source>
        <translation>Balken</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Davor</translation>
    </message>
    <message>
        <source>Bend radius</source>
        <translation>Biegeradius</translation>
    </message>
    <message>
        <source>Bending moment</source>
        <translation>Biegemoment</translation>
    </message>
    <message>
        <source>Bending stiffness</source>
        <translation>Biegesteifigkeit</translation>
    </message>
    <message>
        <source>Between two bodies</source>
        <translation>Zwischen zwei Körpern</translation>
    </message>
    <message>
        <source>Bodies</source>
        <translation>Körper</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>Körper</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Beide</translation>
    </message>
    <message>
        <source>Brake</source>
        <translation>Bremskraft</translation>
    </message>
    <message>
        <source>Buckling</source>
        <translation>Knicken</translation>
    </message>
    <message>
        <source>Buffer</source>
        <translation>Puffer</translation>
    </message>
    <message>
        <source>Cable</source>
        <translation>Kabel</translation>
    </message>
    <message>
        <source>Cable length</source>
        <translation>Kabellänge</translation>
    </message>
    <message>
        <source>Centre of curvature</source>
        <translation>Krümmungsmittelpunkt</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>Clamped</source>
        <translation>Eingespannt</translation>
    </message>
    <message>
        <source>Clear</source>
        <translation>Leeren</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Colours span 98 % of all values; the minimum is {}, the maximum {}</source>
        <translation>Farben überspannen 98 % aller Werte; der kleinste ist {}, der größte {}</translation>
    </message>
    <message>
        <source>Compression only</source>
        <translation>Nur Druck</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>Connector kind</source>
        <translation>Art der Verbindung</translation>
    </message>
    <message>
        <source>Continuous</source>
        <translation>Stetig</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>Ecken</translation>
    </message>
    <message>
        <source>Correct the errors below; a click leads to their objects.</source>
        <translation>Bitte die Fehler unten beheben; ein Klick führt zum Objekt.</translation>
    </message>
    <message>
        <source>Curvature</source>
        <translation>Krümmung</translation>
    </message>
    <message>
        <source>Curve</source>
        <translation>Kurve</translation>
    </message>
    <message>
        <source>Damping</source>
        <translation>Dämpfung</translation>
    </message>
    <message>
        <source>Deformed</source>
        <translation>Verformt</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>Discontinuous</source>
        <translation>Mit Knick</translation>
    </message>
    <message>
        <source>Displacement</source>
        <translation>Verschiebung</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Drag area</source>
        <translation>Widerstandsfläche</translation>
    </message>
    <message>
        <source>Drawn</source>
        <translation>Gezeichnet</translation>
    </message>
    <message>
        <source>Element tolerance</source>
        <translation>Toleranz der Elemente</translation>
    </message>
    <message>
        <source>Elements</source>
        <translation>Elemente</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>End time</source>
        <translation>Endzeit</translation>
    </message>
    <message>
        <source>End: fraction</source>
        <translation>Ende: Anteil</translation>
    </message>
    <message>
        <source>End: length</source>
        <translation>Ende: Länge</translation>
    </message>
    <message>
        <source>End: mass</source>
        <translation>Ende: Masse</translation>
    </message>
    <message>
        <source>End: point</source>
        <translation>Ende: Punkt</translation>
    </message>
    <message>
        <source>End: position by</source>
        <translation>Ende: Stelle nach</translation>
    </message>
    <message>
        <source>End: slope</source>
        <translation>Ende: Steigung</translation>
    </message>
    <message>
        <source>Ended</source>
        <translation>Beendet</translation>
    </message>
    <message>
        <source>Ends</source>
        <translation>Enden</translation>
    </message>
    <message>
        <source>Equilibrium</source>
        <translation>Gleichgewicht</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>Exaggeration</source>
        <translation>Überhöhung</translation>
    </message>
    <message>
        <source>Extra keys</source>
        <translation>Weitere Schlüssel</translation>
    </message>
    <message>
        <source>Extreme fibre</source>
        <translation>Randfaser</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>Gescheitert</translation>
    </message>
    <message>
        <source>Find the cable now, also where it takes longer than a recompute may</source>
        <translation>Das Kabel jetzt suchen, auch wenn es länger dauert, als eine Neuberechnung darf</translation>
    </message>
    <message>
        <source>Flange</source>
        <translation>Flansch</translation>
    </message>
    <message>
        <source>Flip end</source>
        <translation>Ende umkehren</translation>
    </message>
    <message>
        <source>Flip start</source>
        <translation>Anfang umkehren</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Follower</source>
        <translation>Mitdrehend</translation>
    </message>
    <message>
        <source>For beams that are made later</source>
        <translation>Für Balken, die später entstehen</translation>
    </message>
    <message>
        <source>For {}</source>
        <translation>Für {}</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Kraft</translation>
    </message>
    <message>
        <source>Force per length</source>
        <translation>Kraft je Länge</translation>
    </message>
    <message>
        <source>Fork</source>
        <translation>Gabel</translation>
    </message>
    <message>
        <source>Form</source>
        <translation>Form</translation>
    </message>
    <message>
        <source>Fraction</source>
        <translation>Anteil</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Free angle</source>
        <translation>Freier Winkel</translation>
    </message>
    <message>
        <source>Free length</source>
        <translation>Freie Länge</translation>
    </message>
    <message>
        <source>Friction</source>
        <translation>Reibung</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>Gap</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Gravity</source>
        <translation>Schwerkraft</translation>
    </message>
    <message>
        <source>Gravity direction</source>
        <translation>Richtung der Schwerkraft</translation>
    </message>
    <message>
        <source>Guided</source>
        <translation>Geführt</translation>
    </message>
    <message>
        <source>Hard</source>
        <translation>Hart</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Hinge</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Hinge axis</source>
        <translation>Gelenkachse</translation>
    </message>
    <message>
        <source>Hinged</source>
        <translation>Gelenkig</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>Interrupted</source>
        <translation>Abgebrochen</translation>
    </message>
    <message>
        <source>Joint</source>
        <translation>Gelenk</translation>
    </message>
    <message>
        <source>Joint kind</source>
        <translation>Art des Gelenks</translation>
    </message>
    <message>
        <source>Keep this frame</source>
        <translation>Dieses Bild behalten</translation>
    </message>
    <message>
        <source>Leave</source>
        <translation>Verlassen</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Length by</source>
        <translation>Länge nach</translation>
    </message>
    <message>
        <source>Length from start</source>
        <translation>Länge ab Anfang</translation>
    </message>
    <message>
        <source>Length {}, minimum bend radius {}, maximum tension {}</source>
        <translation>Länge {}, kleinster Biegeradius {}, größte Zugkraft {}</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Linie</translation>
    </message>
    <message>
        <source>Load</source>
        <translation>Last</translation>
    </message>
    <message>
        <source>Load kind</source>
        <translation>Art der Last</translation>
    </message>
    <message>
        <source>Load steps</source>
        <translation>Laststufen</translation>
    </message>
    <message>
        <source>Mass</source>
        <translation>Masse</translation>
    </message>
    <message>
        <source>Mass per length</source>
        <translation>Masse je Länge</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>Material</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Metallic area</source>
        <translation>Metallische Fläche</translation>
    </message>
    <message>
        <source>Minimum bend radius</source>
        <translation>Kleinster Biegeradius</translation>
    </message>
    <message>
        <source>Mode count</source>
        <translation>Zahl der Eigenformen</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Modes</source>
        <translation>Eigenformen</translation>
    </message>
    <message>
        <source>Moment</source>
        <translation>Moment</translation>
    </message>
    <message>
        <source>Moment 1</source>
        <translation>Moment 1</translation>
    </message>
    <message>
        <source>Moment 2</source>
        <translation>Moment 2</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>Motion</source>
        <translation>Bewegung</translation>
    </message>
    <message>
        <source>Never run</source>
        <translation>Nie gerechnet</translation>
    </message>
    <message>
        <source>No</source>
        <translation>Nein</translation>
    </message>
    <message>
        <source>Not run.</source>
        <translation>Nicht gerechnet.</translation>
    </message>
    <message>
        <source>Nothing is wrong.</source>
        <translation>Alles in Ordnung.</translation>
    </message>
    <message>
        <source>Numbers</source>
        <translation>Zahlen</translation>
    </message>
    <message>
        <source>Of the pipe</source>
        <translation>Aus dem Rohr</translation>
    </message>
    <message>
        <source>Orientation</source>
        <translation>Ausrichtung</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>Part of a name, as S235</source>
        <translation>Teil eines Namens, etwa S235</translation>
    </message>
    <message>
        <source>Pick</source>
        <translation>Auswählen</translation>
    </message>
    <message>
        <source>Pinned</source>
        <translation>Gelenkig gelagert</translation>
    </message>
    <message>
        <source>Pipe</source>
        <translation>Rohr</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Stelle</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Plot</source>
        <translation>Zeichnen</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Position by</source>
        <translation>Stelle nach</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Messpunkt</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>Pulling force</source>
        <translation>Zugkraft</translation>
    </message>
    <message>
        <source>Pulling mass</source>
        <translation>Zugmasse</translation>
    </message>
    <message>
        <source>Radius</source>
        <translation>Radius</translation>
    </message>
    <message>
        <source>Range</source>
        <translation>Bereich</translation>
    </message>
    <message>
        <source>Rectangle</source>
        <translation>Rechteck</translation>
    </message>
    <message>
        <source>Release</source>
        <translation>Freigabe</translation>
    </message>
    <message>
        <source>Restitution</source>
        <translation>Stoßzahl</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Results</source>
        <translation>Ergebnisse</translation>
    </message>
    <message>
        <source>Reversed</source>
        <translation>Umgekehrt</translation>
    </message>
    <message>
        <source>Rigid</source>
        <translation>Biegesteif</translation>
    </message>
    <message>
        <source>Rigid curve</source>
        <translation>Starre Kurve</translation>
    </message>
    <message>
        <source>Ring</source>
        <translation>Ring</translation>
    </message>
    <message>
        <source>Rod</source>
        <translation>Stab</translation>
    </message>
    <message>
        <source>Roll inertia</source>
        <translation>Rollträgheit</translation>
    </message>
    <message>
        <source>Rope</source>
        <translation>Seil</translation>
    </message>
    <message>
        <source>Rope diameter</source>
        <translation>Seildurchmesser</translation>
    </message>
    <message>
        <source>Rotation axis</source>
        <translation>Drehachse</translation>
    </message>
    <message>
        <source>Rotational</source>
        <translation>Drehfeder</translation>
    </message>
    <message>
        <source>Rotational damping</source>
        <translation>Drehdämpfung</translation>
    </message>
    <message>
        <source>Rotational stiffness</source>
        <translation>Drehsteifigkeit</translation>
    </message>
    <message>
        <source>Round</source>
        <translation>Rund</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Rechnen</translation>
    </message>
    <message>
        <source>Running</source>
        <translation>Läuft</translation>
    </message>
    <message>
        <source>Second moment of area</source>
        <translation>Flächenträgheitsmoment</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Querschnitt</translation>
    </message>
    <message>
        <source>Select in the 3-D view, then press again to take the selection</source>
        <translation>In der 3D-Ansicht auswählen, dann nochmals drücken, um die Auswahl zu übernehmen</translation>
    </message>
    <message>
        <source>Shear force</source>
        <translation>Querkraft</translation>
    </message>
    <message>
        <source>Shown by solid</source>
        <translation>Gezeigt durch Körper</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Slack</source>
        <translation>Überlänge</translation>
    </message>
    <message>
        <source>Slack [%]</source>
        <translation>Überlänge [%]</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Steigung</translation>
    </message>
    <message>
        <source>Smooth</source>
        <translation>Geglättet</translation>
    </message>
    <message>
        <source>Solid</source>
        <translation>Volumenkörper</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Spring</source>
        <translation>Feder</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Anfang</translation>
    </message>
    <message>
        <source>Start: fraction</source>
        <translation>Anfang: Anteil</translation>
    </message>
    <message>
        <source>Start: length</source>
        <translation>Anfang: Länge</translation>
    </message>
    <message>
        <source>Start: mass</source>
        <translation>Anfang: Masse</translation>
    </message>
    <message>
        <source>Start: point</source>
        <translation>Anfang: Punkt</translation>
    </message>
    <message>
        <source>Start: position by</source>
        <translation>Anfang: Stelle nach</translation>
    </message>
    <message>
        <source>Start: slope</source>
        <translation>Anfang: Steigung</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>State at time 0</source>
        <translation>Zustand zur Zeit 0</translation>
    </message>
    <message>
        <source>Static friction</source>
        <translation>Haftreibung</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Stiffness</source>
        <translation>Steifigkeit</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Stop kind</source>
        <translation>Art des Anschlags</translation>
    </message>
    <message>
        <source>Stopping after this step; once more ends it at once.</source>
        <translation>Hält nach diesem Schritt an; nochmals beendet sofort.</translation>
    </message>
    <message>
        <source>Store every</source>
        <translation>Speichern alle</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Gerade</translation>
    </message>
    <message>
        <source>Stress</source>
        <translation>Spannung</translation>
    </message>
    <message>
        <source>Stress-free shape</source>
        <translation>Spannungsfreie Form</translation>
    </message>
    <message>
        <source>Support</source>
        <translation>Lager</translation>
    </message>
    <message>
        <source>Support kind</source>
        <translation>Art des Lagers</translation>
    </message>
    <message>
        <source>Surroundings</source>
        <translation>Umgebung</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabelle</translation>
    </message>
    <message>
        <source>Table over time</source>
        <translation>Tabelle über der Zeit</translation>
    </message>
    <message>
        <source>Take the selection</source>
        <translation>Auswahl übernehmen</translation>
    </message>
    <message>
        <source>Temperature</source>
        <translation>Temperatur</translation>
    </message>
    <message>
        <source>Tension</source>
        <translation>Zugkraft</translation>
    </message>
    <message>
        <source>Tension only</source>
        <translation>Nur Zug</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Threads</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Nach</translation>
    </message>
    <message>
        <source>Tolerance</source>
        <translation>Toleranz</translation>
    </message>
    <message>
        <source>Torque</source>
        <translation>Torsionsmoment</translation>
    </message>
    <message>
        <source>Torque per length</source>
        <translation>Torsionsmoment je Länge</translation>
    </message>
    <message>
        <source>Torsion</source>
        <translation>Torsion</translation>
    </message>
    <message>
        <source>Torsion constant</source>
        <translation>Torsionsträgheitsmoment</translation>
    </message>
    <message>
        <source>Tube</source>
        <translation>Röhre</translation>
    </message>
    <message>
        <source>Twist</source>
        <translation>Verdrehung</translation>
    </message>
    <message>
        <source>Unstressed length</source>
        <translation>Spannungsfreie Länge</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Nach oben</translation>
    </message>
    <message>
        <source>Upright direction</source>
        <translation>Hochrichtung</translation>
    </message>
    <message>
        <source>Velocity</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Von mises</source>
        <translation>Von-Mises-Spannung</translation>
    </message>
    <message>
        <source>Web</source>
        <translation>Steg</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Wind</source>
        <translation>Wind</translation>
    </message>
    <message>
        <source>Wind direction</source>
        <translation>Windrichtung</translation>
    </message>
    <message>
        <source>Wires</source>
        <translation>Drähte</translation>
    </message>
    <message>
        <source>Write the axes of the beams as axes.step beside the case, too?</source>
        <translation>Auch die Achsen der Balken als axes.step neben die Falldatei schreiben?</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Ja</translation>
    </message>
    <message>
        <source>at rest</source>
        <translation>in Ruhe</translation>
    </message>
    <message>
        <source>{} (in this document)</source>
        <translation>{} (in diesem Dokument)</translation>
    </message>
    <message>
        <source>{} ({} of {})</source>
        <translation>{} ({} von {})</translation>
    </message>
    <message>
        <source>{} s to go</source>
        <translation>noch {} s</translation>
    </message>
    <message>
        <source>Inner radius</source>
        <translation>Innenradius</translation>
    </message>
    <message>
        <source>Kind of section</source>
        <translation>Art des Querschnitts</translation>
    </message>
</context>
</TS>
