<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
    <name>Quadrille</name>
    <message>
        <source>Mesh again</source>
        <translation>Erneut vernetzen</translation>
    </message>
    <message>
        <source>Mesh all stale meshes again</source>
        <translation>Alle veralteten Netze erneut vernetzen</translation>
    </message>
    <message>
        <source>{}: the estimated error is {} %, below the target: the mesh stays.</source>
        <translation>{}: Der geschätzte Fehler ist {} %, unter dem gewünschten: Das Netz bleibt.</translation>
    </message>
    <message>
        <source>{}: the estimated error was {} %; now there are {} quads: solve again.</source>
        <translation>{}: Der geschätzte Fehler war {} %; jetzt sind es {} Vierecke: neu rechnen.</translation>
    </message>
    <message>
        <source>Show part / mesh</source>
        <translation>Teil / Netz zeigen</translation>
    </message>
    <message>
        <source>Shows the mesh instead of the part, or the part instead of the mesh</source>
        <translation>Zeigt das Netz anstelle des Teils oder das Teil anstelle des Netzes</translation>
    </message>
    <message>
        <source>open a document first</source>
        <translation>zuerst ein Dokument öffnen</translation>
    </message>
    <message>
        <source>the document has no quad mesh: select a part and use Quad mesh from shape first</source>
        <translation>das Dokument hat kein Vierecknetz: zuerst ein Teil wählen und „Vierecknetz aus Form“ verwenden</translation>
    </message>
    <message>
        <source>the document has several quad meshes: select one of them</source>
        <translation>das Dokument hat mehrere Vierecknetze: eines davon wählen</translation>
    </message>
    <message>
        <source>{}: is not meshed yet: double-click it and press Mesh</source>
        <translation>{}: ist noch nicht vernetzt: doppelklicken und „Vernetzen“ drücken</translation>
    </message>
    <message>
        <source>Open a document first.</source>
        <translation>Zuerst ein Dokument öffnen.</translation>
    </message>
    <message>
        <source>select one part to mesh, or several</source>
        <translation>ein Teil zum Vernetzen wählen, oder mehrere</translation>
    </message>
    <message>
        <source>select faces, edges or vertices of the part first</source>
        <translation>zuerst Flächen, Kanten oder Ecken des Teils wählen</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Verfeinern</translation>
    </message>
    <message>
        <source>Element size</source>
        <translation>Elementgröße</translation>
    </message>
    <message>
        <source>no face of {} is selected: select its faces, or nothing to flip all of them</source>
        <translation>nichts vom Gewählten ist eine Fläche von {}: seine Flächen wählen, oder nichts, um alle umzudrehen</translation>
    </message>
    <message>
        <source>{}: &apos;{}&apos; is not a length, such as 0.5 mm or 1/8 in</source>
        <translation>{}: „{}“ ist keine Länge wie 0,5 mm oder 1/8 in</translation>
    </message>
    <message>
        <source>General</source>
        <translation>Allgemein</translation>
    </message>
    <message>
        <source>Mesher</source>
        <translation>Vernetzer</translation>
    </message>
    <message>
        <source>found automatically</source>
        <translation>wird von selbst gefunden</translation>
    </message>
    <message>
        <source>Path of the quadrille command if it is not on PATH</source>
        <translation>Pfad des Befehls quadrille, wenn er nicht auf PATH liegt</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>Settings of new meshes</source>
        <translation>Neue Netze beginnen mit</translation>
    </message>
    <message>
        <source>Elements, about</source>
        <translation>Elemente, etwa</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Threads</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aussehen</translation>
    </message>
    <message>
        <source>Color a mesh by quality when it is made</source>
        <translation>Ein neues Netz nach Qualität färben</translation>
    </message>
    <message>
        <source>Width of lines</source>
        <translation>Linienbreite</translation>
    </message>
    <message>
        <source>The quadrille command</source>
        <translation>Der Befehl quadrille</translation>
    </message>
    <message>
        <source>uses {}</source>
        <translation>verwendet {}</translation>
    </message>
    <message>
        <source>q</source>
        <translation>q</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Seitenverhältnis</translation>
    </message>
    <message>
        <source>Warp</source>
        <translation>Verwindung</translation>
    </message>
    <message>
        <source>Skew</source>
        <translation>Schiefe</translation>
    </message>
    <message>
        <source>Smallest angle</source>
        <translation>Kleinster Winkel</translation>
    </message>
    <message>
        <source>Largest angle</source>
        <translation>Größter Winkel</translation>
    </message>
    <message>
        <source>Jacobian ratio</source>
        <translation>Jacobi-Verhältnis</translation>
    </message>
    <message>
        <source>Taper</source>
        <translation>Verjüngung</translation>
    </message>
    <message>
        <source>Criterion</source>
        <translation>Kriterium</translation>
    </message>
    <message>
        <source>Fail</source>
        <translation>Außen</translation>
    </message>
    <message>
        <source>Worst</source>
        <translation>Ärgste</translation>
    </message>
    <message>
        <source>Color the mesh</source>
        <translation>Netz färben</translation>
    </message>
    <message>
        <source>Blue is good, red is bad; for a criterion, yellow is at its limit</source>
        <translation>Blau ist gut, Rot ist schlecht; bei einem Kriterium liegt Gelb auf der Grenze</translation>
    </message>
    <message>
        <source>Show free sides</source>
        <translation>Freie Seiten zeigen</translation>
    </message>
    <message>
        <source>Sides of one element only, and nodes at the same place</source>
        <translation>Seiten, die nur ein Element hat, und Knoten am selben Ort</translation>
    </message>
    <message>
        <source>Worst elements (click on one)</source>
        <translation>Schlechteste Elemente (anklicken)</translation>
    </message>
    <message>
        <source>Quads</source>
        <translation>Vierecke</translation>
    </message>
    <message>
        <source>Nodes</source>
        <translation>Knoten</translation>
    </message>
    <message>
        <source>q: smallest, mean</source>
        <translation>q: kleinstes, Mittel</translation>
    </message>
    <message>
        <source>Jacobian</source>
        <translation>Jacobi</translation>
    </message>
    <message>
        <source>Irregular nodes</source>
        <translation>Irreguläre Knoten</translation>
    </message>
    <message>
        <source>Outside limits</source>
        <translation>Außer Grenzen</translation>
    </message>
    <message>
        <source>Without warp and short sides, which the table below counts</source>
        <translation>Ohne Verwindung und kurze Seiten, die die Tabelle darunter zählt</translation>
    </message>
    <message>
        <source>Mesher&apos;s time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Quality of {}</source>
        <translation>Qualität von {}</translation>
    </message>
    <message>
        <source>Refine selection</source>
        <translation>Auswahl verfeinern</translation>
    </message>
    <message>
        <source>Set the element size on the selected faces, edges or vertices</source>
        <translation>Den gewählten Flächen, Kanten oder Ecken eine eigene Größe geben</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Verfeinerung</translation>
    </message>
    <message>
        <source>Remove this refinement</source>
        <translation>Diese Verfeinerung entfernen</translation>
    </message>
    <message>
        <source>Quad mesh</source>
        <translation>Vierecknetz</translation>
    </message>
    <message>
        <source>Suggest</source>
        <translation>Vorschlag</translation>
    </message>
    <message>
        <source>The size that gives about {} elements</source>
        <translation>Die Größe, die etwa {} Elemente ergibt</translation>
    </message>
    <message>
        <source>Mesh only the faces that are selected in the 3-D view</source>
        <translation>Nur die Flächen vernetzen, die in der 3D-Ansicht gewählt sind</translation>
    </message>
    <message>
        <source>Stresses at the surfaces</source>
        <translation>Spannungen an der Oberfläche</translation>
    </message>
    <message>
        <source>CalculiX then gives results at the top and bottom of the shell, where bending stresses occur, not only at its middle (the solver&apos;s property Beam Shell Result Output 3D)</source>
        <translation>CalculiX gibt dann Ergebnisse an Ober- und Unterseite der Schale, wo Biegespannungen sind, und nicht nur in ihrer Mitte (Eigenschaft „Beam Shell Result Output 3D“ des Lösers)</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Vernetzen</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Ends the mesher</source>
        <translation>Beendet den Vernetzer</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>Teil</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Erwartet</translation>
    </message>
    <message>
        <source>Refinements</source>
        <translation>Verfeinerungen</translation>
    </message>
    <message>
        <source>More settings</source>
        <translation>Weitere Einstellungen</translation>
    </message>
    <message>
        <source>about {} quads</source>
        <translation>etwa {} Vierecke</translation>
    </message>
    <message>
        <source>Select them on {} in the 3-D view first.</source>
        <translation>Zuerst auf {} in der 3D-Ansicht auswählen.</translation>
    </message>
    <message>
        <source>meshing</source>
        <translation>vernetze</translation>
    </message>
    <message>
        <source>{} quads: mesher {} s, into FreeCAD {} s</source>
        <translation>{} Vierecke: Vernetzer {} s, nach FreeCAD {} s</translation>
    </message>
    <message>
        <source>Another task panel is open: close it first.</source>
        <translation>Ein anderes Aufgabenfenster ist offen: zuerst schließen.</translation>
    </message>
    <message>
        <source>{}: the part that it meshes is gone.</source>
        <translation>{}: das Teil, das es vernetzt, ist weg.</translation>
    </message>
    <message>
        <source>Get the mesher</source>
        <translation>Netzgenerator holen</translation>
    </message>
    <message>
        <source>Use the one on PATH</source>
        <translation>Den aus PATH nehmen</translation>
    </message>
    <message>
        <source>There is no command quadrille on PATH</source>
        <translation>In PATH gibt es keinen Befehl quadrille</translation>
    </message>
    <message>
        <source>Use a bundle file ...</source>
        <translation>Datei eines Pakets nehmen …</translation>
    </message>
    <message>
        <source>Download</source>
        <translation>Herunterladen</translation>
    </message>
    <message>
        <source>A bundle is unpacked into {}, tested, and entered in the preferences. Nothing else is changed.</source>
        <translation>Ein Paket wird nach {} entpackt, ausprobiert und in den Einstellungen eingetragen. Sonst wird nichts geändert.</translation>
    </message>
    <message>
        <source>Install it</source>
        <translation>Installieren</translation>
    </message>
    <message>
        <source>A bundle of Quadrille</source>
        <translation>Ein Paket von Quadrille</translation>
    </message>
    <message>
        <source>downloading {}</source>
        <translation>lädt {}</translation>
    </message>
    <message>
        <source>unpacking {}</source>
        <translation>entpackt {}</translation>
    </message>
    <message>
        <source>{} has the SHA-256
{}
Compare it with the one published with the file. Installing unpacks it into {} and runs it.</source>
        <translation>{} hat die SHA-256
{}
Vergleichen Sie sie mit der, die bei der Datei veröffentlicht ist. Beim Installieren wird sie nach {} entpackt und ausgeführt.</translation>
    </message>
    <message>
        <source>select one thin part, or several that touch</source>
        <translation>ein dünnes Teil wählen, oder mehrere, die sich berühren</translation>
    </message>
    <message>
        <source>{}. Use the walls that could be paired?</source>
        <translation>{}. Nehmen, was gepaart werden konnte?</translation>
    </message>
    <message>
        <source>{} are on {}. Move them to its middle surface?</source>
        <translation>{} liegen auf {}. Auf dessen Mittelfläche übertragen?</translation>
    </message>
    <message>
        <source>{} may be a thin solid, of about {} mm: a mesh of its skin is a hollow box, and shell stresses on it are meaningless.</source>
        <translation>{} ist vielleicht ein dünner Körper von etwa {} mm: Seine Haut ist dann ein hohler Kasten, und Schalenspannungen darauf besagen nichts.</translation>
    </message>
    <message>
        <source>Make its middle surface</source>
        <translation>Mittelfläche erzeugen</translation>
    </message>
    <message>
        <source>select one mesh object, such as an STL file that was imported</source>
        <translation>ein Netzobjekt wählen, etwa eine importierte STL-Datei</translation>
    </message>
    <message>
        <source>{}: the mesh object that it meshes is gone</source>
        <translation>{}: das Netzobjekt, das es vernetzt, ist weg</translation>
    </message>
    <message>
        <source>Quad mesh of {}</source>
        <translation>Vierecknetz von {}</translation>
    </message>
    <message>
        <source>{}: its normals are those of {}: flip them there (Meshes, Flip normals), and mesh again</source>
        <translation>{}: seine Normalen sind die von {}: dort umdrehen (Netze, Normalen umkehren) und neu vernetzen</translation>
    </message>
    <message>
        <source>none: one face</source>
        <translation>keiner: eine Fläche</translation>
    </message>
    <message>
        <source>Finding the middle surface of {}...</source>
        <translation>Suche die Mittelfläche von {} …</translation>
    </message>
    <message>
        <source>Meshing {}...</source>
        <translation>Vernetze {} …</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>the element size must be larger than 0</source>
        <translation>die Elementgröße muss größer als 0 sein</translation>
    </message>
    <message>
        <source>Element order</source>
        <translation>Elementordnung</translation>
    </message>
    <message>
        <source>New face from a fold of</source>
        <translation>Neue Fläche ab einem Knick von</translation>
    </message>
    <message>
        <source>Merge nodes closer than</source>
        <translation>Knoten verschmelzen, näher als</translation>
    </message>
    <message>
        <source>Adapting {}</source>
        <translation>{} wird angepasst</translation>
    </message>
    <message>
        <source>Adapt {} to results</source>
        <translation>{} an Ergebnisse anpassen</translation>
    </message>
    <message>
        <source>Target error of the stresses, percent</source>
        <translation>Gewünschter Fehler der Spannungen, Prozent</translation>
    </message>
    <message>
        <source>{} of {}: give its numbers, or remove it</source>
        <translation>{} von {}: Zahlen angeben oder entfernen</translation>
    </message>
    <message>
        <source>Preview sizes</source>
        <translation>Größenvorschau</translation>
    </message>
    <message>
        <source>Show the element sizes in colors, and what requests them, before meshing</source>
        <translation>Vor dem Vernetzen in Farben zeigen, wie groß die Elemente würden und was das verlangt</translation>
    </message>
    <message>
        <source>finding sizes</source>
        <translation>Größen werden bestimmt</translation>
    </message>
    <message>
        <source>finding sizes: {} %</source>
        <translation>Größen werden bestimmt: {} %</translation>
    </message>
    <message>
        <source>dark {} mm, light {} mm</source>
        <translation>dunkel {} mm, hell {} mm</translation>
    </message>
    <message>
        <source>bends: size across them; quads are up to {} times as long</source>
        <translation>Biegungen: Größe quer zu ihnen; Vierecke sind bis zu {}-mal so lang</translation>
    </message>
    <message>
        <source>{}: {:.0f} quads on {} % of the area</source>
        <translation>{}: {:.0f} Vierecke auf {} % der Fläche</translation>
    </message>
    <message>
        <source>Follow results</source>
        <translation>Ergebnissen folgen</translation>
    </message>
    <message>
        <source>Divide selected edges</source>
        <translation>Gewählte Kanten teilen</translation>
    </message>
    <message>
        <source>Set the number of elements on the selected edges</source>
        <translation>Wie viele Elemente die gewählten Kanten bekommen</translation>
    </message>
    <message>
        <source>Expected by face</source>
        <translation>Erwartet je Fläche</translation>
    </message>
    <message>
        <source>{} has no {}</source>
        <translation>{} hat kein {}</translation>
    </message>
    <message>
        <source>Shortest side</source>
        <translation>Kürzeste Seite</translation>
    </message>
    <message>
        <source>Nodes at selected points</source>
        <translation>Knoten an gewählten Punkten</translation>
    </message>
    <message>
        <source>Put a node, with a group of its own, at each selected vertex or point object</source>
        <translation>Setzt an jede gewählte Ecke und jedes gewählte Punktobjekt einen Knoten mit eigener Gruppe</translation>
    </message>
    <message>
        <source>Select vertices or points in the 3-D view or the tree first.</source>
        <translation>Wählen Sie zuerst Ecken oder Punkte in der 3D-Ansicht oder im Baum.</translation>
    </message>
    <message>
        <source>Refine here</source>
        <translation>Hier verfeinern</translation>
    </message>
    <message>
        <source>Element {} on {}: q {}, aspect {}, angles {} to {} degrees</source>
        <translation>Element {} auf {}: q {}, Seitenverhältnis {}, Winkel {} bis {} Grad</translation>
    </message>
    <message>
        <source>forced by {}</source>
        <translation>erzwungen von {}</translation>
    </message>
    <message>
        <source>the mesh is not in an analysis: drag it into one in the tree</source>
        <translation>das Netz liegt in keiner Analyse: im Baum in eine ziehen</translation>
    </message>
    <message>
        <source>its analysis is not the active one: double-click it</source>
        <translation>seine Analyse ist nicht die aktive: doppelklicken</translation>
    </message>
    <message>
        <source>the analysis has no material</source>
        <translation>die Analyse hat kein Material</translation>
    </message>
    <message>
        <source>the analysis has no shell thickness (Model &gt; Element geometry)</source>
        <translation>die Analyse hat keine Schalendicke (Modell &gt; Elementgeometrie)</translation>
    </message>
    <message>
        <source>the mesh is in pieces that share no nodes: Imprint or Sew joins parts that touch</source>
        <translation>das Netz hat Teile ohne gemeinsame Knoten: Verschneiden oder Nähen verbindet, was sich berührt</translation>
    </message>
    <message>
        <source>stresses come from the middle of the shell only: tick Stresses at the surfaces</source>
        <translation>Spannungen kommen nur aus der Mitte der Schale: Spannungen an der Oberfläche</translation>
    </message>
    <message>
        <source>Missing before solving: {}</source>
        <translation>Vor dem Lösen fehlt: {}</translation>
    </message>
    <message>
        <source>Nothing is missing before solving</source>
        <translation>Vor dem Lösen fehlt nichts</translation>
    </message>
    <message>
        <source>waits until the open panel or command has ended</source>
        <translation>wartet, bis das offene Aufgabenfenster oder der Befehl beendet ist</translation>
    </message>
    <message>
        <source>{}: {} quads</source>
        <translation>{}: {} Vierecke</translation>
    </message>
    <message>
        <source>Finding a size</source>
        <translation>Suche eine Größe</translation>
    </message>
    <message>
        <source>{}: not meshed, since its panel was closed</source>
        <translation>{}: nicht vernetzt, weil das Aufgabenfenster geschlossen wurde</translation>
    </message>
    <message>
        <source>plane stress</source>
        <translation>ebener Spannungszustand</translation>
    </message>
    <message>
        <source>plane strain</source>
        <translation>ebener Dehnungszustand</translation>
    </message>
    <message>
        <source>rotational symmetry</source>
        <translation>Rotationssymmetrie</translation>
    </message>
    <message>
        <source>membrane</source>
        <translation>Membran</translation>
    </message>
    <message>
        <source>shell</source>
        <translation>Schale</translation>
    </message>
    <message>
        <source>four nodes</source>
        <translation>vier Knoten</translation>
    </message>
    <message>
        <source>eight nodes</source>
        <translation>acht Knoten</translation>
    </message>
    <message>
        <source>reduced integration</source>
        <translation>reduzierte Integration</translation>
    </message>
    <message>
        <source>full integration</source>
        <translation>volle Integration</translation>
    </message>
    <message>
        <source>S4 at first order; S8R, with reduced integration, at second</source>
        <translation>S4 bei erster Ordnung; S8R, mit reduzierter Integration, bei zweiter</translation>
    </message>
    <message>
        <source>Type of the elements for CalculiX; those for planes and rotational symmetry need a part in the plane z = 0</source>
        <translation>Typ der Elemente für CalculiX; die für Ebenen und Rotationssymmetrie brauchen ein Teil in der Ebene z = 0</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>reading the part</source>
        <translation>liest das Teil</translation>
    </message>
    <message>
        <source>finding the middle surface</source>
        <translation>sucht die Mittelfläche</translation>
    </message>
    <message>
        <source>dividing edges</source>
        <translation>teilt Kanten</translation>
    </message>
    <message>
        <source>meshing faces</source>
        <translation>vernetzt Flächen</translation>
    </message>
    <message>
        <source>making triangles</source>
        <translation>bildet Dreiecke</translation>
    </message>
    <message>
        <source>pairing triangles</source>
        <translation>paart Dreiecke</translation>
    </message>
    <message>
        <source>making quads</source>
        <translation>bildet Vierecke</translation>
    </message>
    <message>
        <source>improving quads</source>
        <translation>verbessert Vierecke</translation>
    </message>
    <message>
        <source>moving nodes</source>
        <translation>verschiebt Knoten</translation>
    </message>
    <message>
        <source>joining faces</source>
        <translation>verbindet Flächen</translation>
    </message>
    <message>
        <source>writing the mesh</source>
        <translation>schreibt das Netz</translation>
    </message>
    <message>
        <source>From selection</source>
        <translation>Aus Auswahl</translation>
    </message>
    <message>
        <source>Elements</source>
        <translation>Elemente</translation>
    </message>
    <message>
        <source>Half the size of the element, in a ball three elements wide around it</source>
        <translation>Halbe Größe des Elements, in einer Kugel um es, die drei Elemente breit ist</translation>
    </message>
    <message>
        <source>refined where asked: the smallest q fell from {} to {}</source>
        <translation>wie verlangt verfeinert: das kleinste q fiel von {} auf {}</translation>
    </message>
    <message>
        <source>Hidden in it, and not meshed: {}</source>
        <translation>Darin ausgeblendet und nicht vernetzt: {}</translation>
    </message>
    <message>
        <source>{} has {} solids that touch or cross. Join them there (Imprint), so that they share nodes?</source>
        <translation>{} hat {} Körper, die sich berühren oder schneiden. Dort verbinden (Verschneiden), so dass sie Knoten teilen?</translation>
    </message>
    <message>
        <source>tiny: replaced by an edge or a node of its neighbors</source>
        <translation>winzig: eine Kante oder ein Knoten der Nachbarn ersetzt sie</translation>
    </message>
    <message>
        <source>in a filled hole</source>
        <translation>in einem gefüllten Loch</translation>
    </message>
    <message>
        <source>joined with {}: coplanar</source>
        <translation>mit {} vereint: in einer Ebene</translation>
    </message>
    <message>
        <source>joined with {}: facets</source>
        <translation>mit {} vereint: Facetten</translation>
    </message>
    <message>
        <source>crossed: covered by quads whose centers lie on its neighbors</source>
        <translation>gekreuzt: bedeckt von Vierecken, deren Mitten auf den Nachbarn liegen</translation>
    </message>
    <message>
        <source>no edge or angle there is too small; the mesh itself is irregular there</source>
        <translation>keine Kante und kein Winkel ist dort zu klein; das Netz selbst ist dort unregelmäßig</translation>
    </message>
    <message>
        <source>small, but meshed: {}</source>
        <translation>klein, aber vernetzt: {}</translation>
    </message>
    <message>
        <source>boss on {} that is left out</source>
        <translation>weggelassene Erhebung auf {}</translation>
    </message>
    <message>
        <source>hole in {} that is filled</source>
        <translation>gefülltes Loch in {}</translation>
    </message>
    <message>
        <source>too small: {} stands for it</source>
        <translation>zu klein: {} steht dafür</translation>
    </message>
    <message>
        <source>poor quads: {}; {}</source>
        <translation>schlechte Vierecke: {}; {}</translation>
    </message>
    <message>
        <source>smooth edge that quads cross; on {}</source>
        <translation>glatte Kante, die Vierecke kreuzen; an {}</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Of what is suppressed: how far it lies from what stands for it; of an edge that quads cross: how far it lies from them; of a filled hole: its width; of poor quads: their shortest side</source>
        <translation>Bei Unterdrücktem: wie weit es von dem liegt, was dafür steht; bei gekreuzten Kanten: wie weit sie von den Vierecken liegen; bei gefüllten Löchern: die Breite; bei schlechten Vierecken: die kürzeste Seite</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Size in</source>
        <translation>Größe in</translation>
    </message>
    <message>
        <source>Segments</source>
        <translation>Segmente</translation>
    </message>
    <message>
        <source>Bias</source>
        <translation>Abstufung</translation>
    </message>
    <message>
        <source>Bias from both ends</source>
        <translation>Abstufung von beiden Enden</translation>
    </message>
    <message>
        <source>Node</source>
        <translation>Knoten</translation>
    </message>
    <message>
        <source>In the next mesh, the faces and edges selected here or in the 3-D view keep nodes of their own</source>
        <translation>Im nächsten Netz behalten die hier oder in der 3D-Ansicht gewählten Flächen und Kanten eigene Knoten</translation>
    </message>
    <message>
        <source>Suppress</source>
        <translation>Unterdrücken</translation>
    </message>
    <message>
        <source>The selected faces and edges are no longer kept: where they are small, they may be suppressed or crossed in the next mesh</source>
        <translation>Die gewählten Flächen und Kanten werden nicht mehr behalten: wo sie klein sind, dürfen sie im nächsten Netz unterdrückt oder gekreuzt werden</translation>
    </message>
    <message>
        <source>to be kept</source>
        <translation>wird behalten</translation>
    </message>
    <message>
        <source>it is {} long</source>
        <translation>sie ist {} lang</translation>
    </message>
    <message>
        <source>its sides meet at {} degrees at {}</source>
        <translation>ihre Seiten bilden {} Grad an {}</translation>
    </message>
    <message>
        <source>{} comes within {} of itself</source>
        <translation>{} kommt sich selbst bis auf {} nahe</translation>
    </message>
    <message>
        <source>{} and {} come within {} of each other</source>
        <translation>{} und {} kommen sich bis auf {} nahe</translation>
    </message>
    <message>
        <source>a loop of {} would be too small for elements</source>
        <translation>eine Schleife von {} wäre zu klein für Elemente</translation>
    </message>
    <message>
        <source>{} is so narrow that it would lose much of its area</source>
        <translation>{} ist so schmal, dass viel von ihrem Inhalt verloren ginge</translation>
    </message>
    <message>
        <source>two edges of {} would share their nodes</source>
        <translation>zwei Kanten von {} hätten dieselben Knoten</translation>
    </message>
    <message>
        <source>a node is placed at its boundary</source>
        <translation>an ihrem Rand ist ein Knoten vorgegeben</translation>
    </message>
    <message>
        <source>its long sides are not everywhere close together</source>
        <translation>ihre langen Seiten liegen nicht überall dicht beieinander</translation>
    </message>
    <message>
        <source>{} has no valid mesh without it</source>
        <translation>{} hat ohne sie kein gültiges Netz</translation>
    </message>
    <message>
        <source>{} more that do less harm</source>
        <translation>{} weitere, die weniger schaden</translation>
    </message>
    <message>
        <source>{}: which face, edge or vertex of {} {} was ({}) cannot be identified since the part was changed: choose it again</source>
        <translation>{}: welche Fläche, Kante oder Ecke von {} {} war ({}), ist seit der Änderung des Teils nicht mehr zu erkennen: neu wählen</translation>
    </message>
    <message>
        <source>{}: {} is no longer on its surface</source>
        <translation>{}: {} liegt nicht mehr auf seiner Oberfläche</translation>
    </message>
    <message>
        <source>{}: {}; until then, pick its faces, edges and vertices on the part</source>
        <translation>{}: {}; bis dahin Flächen, Kanten und Ecken am Teil wählen</translation>
    </message>
    <message>
        <source>select the faces, edges or vertices to refine</source>
        <translation>die Flächen, Kanten oder Ecken wählen, die verfeinert werden sollen</translation>
    </message>
    <message>
        <source>a refinement needs a size larger than 0, not {}</source>
        <translation>eine Verfeinerung braucht eine Größe über 0, nicht {}</translation>
    </message>
    <message>
        <source>a size of {:.3g} mm is too small for a part of {:.3g} mm</source>
        <translation>eine Größe von {:.3g} mm ist zu klein für ein Teil von {:.3g} mm</translation>
    </message>
    <message>
        <source>a size of {:.3g} mm is larger than the model, whose diagonal is {:.3g} mm</source>
        <translation>eine Größe von {:.3g} mm ist größer als das Modell, dessen Diagonale {:.3g} mm hat</translation>
    </message>
    <message>
        <source>{}: the part has no such face to flip</source>
        <translation>{}: das Teil hat keine solche Fläche zum Umkehren</translation>
    </message>
    <message>
        <source>the normals cannot be flipped: the part has edges or vertices that belong to no face</source>
        <translation>die Normalen sind nicht umkehrbar: das Teil hat Kanten oder Ecken, die zu keiner Fläche gehören</translation>
    </message>
    <message>
        <source>{}.{}: is not in the meshed part</source>
        <translation>{}.{}: gehört nicht zum vernetzten Teil</translation>
    </message>
    <message>
        <source>Solid{}: is not in the meshed part</source>
        <translation>Solid{}: gehört nicht zum vernetzten Teil</translation>
    </message>
    <message>
        <source>{}: the part that it meshes is gone</source>
        <translation>{}: das Teil, das es vernetzt, ist weg</translation>
    </message>
    <message>
        <source>{}: has no shape to mesh</source>
        <translation>{}: hat keine Form zum Vernetzen</translation>
    </message>
    <message>
        <source>{}: its shape has no faces to mesh</source>
        <translation>{}: seine Form hat keine Flächen zum Vernetzen</translation>
    </message>
    <message>
        <source>{}: a mesh region needs a length larger than 0</source>
        <translation>{}: ein Netzbereich braucht eine Länge über 0</translation>
    </message>
    <message>
        <source>{}: its sizes from results cannot be read ({}): switch {} off</source>
        <translation>{}: seine Größen aus Ergebnissen sind nicht lesbar ({}): {} ausschalten</translation>
    </message>
    <message>
        <source>{}: its SizeField is set, which the sizes from results would replace: clear it first</source>
        <translation>{}: SizeField ist gesetzt, und die Größen aus Ergebnissen würden es ersetzen: zuerst leeren</translation>
    </message>
    <message>
        <source>{}: is not in an analysis: add it to one, and solve that first</source>
        <translation>{}: ist in keiner Analyse: zu einer hinzufügen, und diese zuerst lösen</translation>
    </message>
    <message>
        <source>{}: has no result with displacements: solve it with {} first</source>
        <translation>{}: hat kein Ergebnis mit Verschiebungen: zuerst mit {} lösen</translation>
    </message>
    <message>
        <source>{}: its nodes are displaced: set DisplaceMesh of {} to false, and solve again</source>
        <translation>{}: seine Knoten sind verschoben: DisplaceMesh von {} auf false setzen und neu lösen</translation>
    </message>
    <message>
        <source>{}: has results at the middle of the shell only: set {} of {} to true, and solve again</source>
        <translation>{}: hat nur Ergebnisse in der Mitte der Schale: {} von {} auf true setzen und neu lösen</translation>
    </message>
    <message>
        <source>{}: has no shell elements: an element has {} nodes</source>
        <translation>{}: hat keine Schalenelemente: ein Element hat {} Knoten</translation>
    </message>
    <message>
        <source>{}: has no displacements: solve again</source>
        <translation>{}: hat keine Verschiebungen: neu lösen</translation>
    </message>
    <message>
        <source>{}: is being meshed already; wait for it, or cancel it first</source>
        <translation>{}: wird schon vernetzt; darauf warten oder es zuerst abbrechen</translation>
    </message>
    <message>
        <source>{}: has no face {} to flip</source>
        <translation>{}: hat keine Fläche {} zum Umkehren</translation>
    </message>
    <message>
        <source>{}: {}; nothing was exported</source>
        <translation>{}: {}; nichts wurde exportiert</translation>
    </message>
    <message>
        <source>{}: the mesher now gives another mesh (its version has changed, or the part was recomputed and differs by rounding): mesh again, then export</source>
        <translation>{}: der Vernetzer liefert jetzt ein anderes Netz (andere Version, oder das Teil wurde neu berechnet und weicht um Rundung ab): neu vernetzen, dann exportieren</translation>
    </message>
    <message>
        <source>{}: cannot be written: {}</source>
        <translation>{}: kann nicht geschrieben werden: {}</translation>
    </message>
    <message>
        <source>{}: is not a FEM analysis</source>
        <translation>{}: ist keine FEM-Analyse</translation>
    </message>
    <message>
        <source>{}: already holds the mesh {}, and FreeCAD solves with one mesh only</source>
        <translation>{}: enthält schon das Netz {}, und FreeCAD löst mit nur einem Netz</translation>
    </message>
    <message>
        <source>{}: has no solid; a middle surface is made of solids</source>
        <translation>{}: hat keinen Festkörper; eine Mittelfläche entsteht aus Festkörpern</translation>
    </message>
    <message>
        <source>{}: is not a mesh object; select one, such as an STL file that was imported</source>
        <translation>{}: ist kein Netzobjekt; eines wählen, etwa eine importierte STL-Datei</translation>
    </message>
    <message>
        <source>{}: has no triangles to mesh</source>
        <translation>{}: hat keine Dreiecke zum Vernetzen</translation>
    </message>
    <message>
        <source>{}: cannot be meshed at size {:g}: it must be larger than 0</source>
        <translation>{}: mit Größe {:g} nicht zu vernetzen: sie muss über 0 sein</translation>
    </message>
    <message>
        <source>{}: its {} faces need more than {}, unless elements are larger than a tenth of the part</source>
        <translation>{}: seine {} Flächen brauchen mehr als {}, wenn Elemente nicht größer als ein Zehntel des Teils sind</translation>
    </message>
    <message>
        <source>{}: not on the list of what is to be kept; the table says why the mesher itself keeps an edge</source>
        <translation>{}: steht nicht auf der Liste dessen, was erhalten bleiben soll; die Tabelle sagt, warum der Vernetzer selbst eine Kante erhält</translation>
    </message>
    <message>
        <source>the folder for temporary files</source>
        <translation>der Ordner für temporäre Dateien</translation>
    </message>
    <message>
        <source>{}: no temporary folder can be made there ({}); set the environment variable TMPDIR to a folder that can be written</source>
        <translation>{}: dort kann kein temporärer Ordner angelegt werden ({}); die Umgebungsvariable TMPDIR auf einen beschreibbaren Ordner setzen</translation>
    </message>
    <message>
        <source>flatpak-spawn: cannot run programs outside of Flatpak ({}); allow it with &apos;flatpak override --user --talk-name=org.freedesktop.Flatpak org.freecad.FreeCAD&apos;</source>
        <translation>flatpak-spawn: kann keine Programme außerhalb von Flatpak ausführen ({}); erlauben mit 'flatpak override --user --talk-name=org.freedesktop.Flatpak org.freecad.FreeCAD'</translation>
    </message>
    <message>
        <source>the argument &apos;command&apos;</source>
        <translation>das Argument 'command'</translation>
    </message>
    <message>
        <source>the environment variable QUADRILLE_COMMAND</source>
        <translation>die Umgebungsvariable QUADRILLE_COMMAND</translation>
    </message>
    <message>
        <source>the preference &apos;Command&apos;</source>
        <translation>die Einstellung 'Command'</translation>
    </message>
    <message>
        <source>{}: cannot be run, though {} names it as the mesher</source>
        <translation>{}: lässt sich nicht ausführen, obwohl es als Vernetzer angegeben ist ({})</translation>
    </message>
    <message>
        <source>the command &apos;quadrille&apos; is not on PATH; install it, or name its path in the environment variable QUADRILLE_COMMAND or in the preference Mod/Quadrille/Command</source>
        <translation>der Befehl 'quadrille' ist nicht im PATH; ihn installieren oder seinen Pfad in der Umgebungsvariable QUADRILLE_COMMAND oder in der Einstellung Mod/Quadrille/Command angeben</translation>
    </message>
    <message>
        <source>{}: does not print its version ({}); install Quadrille {}</source>
        <translation>{}: gibt seine Version nicht aus ({}); Quadrille {} installieren</translation>
    </message>
    <message>
        <source>{}: is not the quadrille command; install Quadrille {}, or correct the preference Mod/Quadrille/Command</source>
        <translation>{}: ist nicht der Befehl quadrille; Quadrille {} installieren oder die Einstellung Mod/Quadrille/Command berichtigen</translation>
    </message>
    <message>
        <source>{}: is of version {}, and this addon needs {}; install the two from one release</source>
        <translation>{}: hat die Version {}, diese Erweiterung braucht {}; beide aus derselben Ausgabe installieren</translation>
    </message>
    <message>
        <source>the work was cancelled</source>
        <translation>die Arbeit wurde abgebrochen</translation>
    </message>
    <message>
        <source>{}: cannot be started: {}</source>
        <translation>{}: lässt sich nicht starten: {}</translation>
    </message>
    <message>
        <source>the mesher was killed by signal {}</source>
        <translation>der Vernetzer wurde durch das Signal {} beendet</translation>
    </message>
    <message>
        <source>the meshing was cancelled</source>
        <translation>das Vernetzen wurde abgebrochen</translation>
    </message>
    <message>
        <source>the mesher ended with exit code {}</source>
        <translation>der Vernetzer endete mit dem Code {}</translation>
    </message>
    <message>
        <source>FreeCAD read {} of the {} quads that {} wrote</source>
        <translation>FreeCAD hat {} der {} Vierecke gelesen, die {} geschrieben hat</translation>
    </message>
    <message>
        <source>the shape has no faces to mesh</source>
        <translation>die Form hat keine Flächen zum Vernetzen</translation>
    </message>
    <message>
        <source>{}: cannot be read ({})</source>
        <translation>{}: lässt sich nicht lesen ({})</translation>
    </message>
    <message>
        <source>{}: is not the address of a file (https://.../quadrille-...tar.xz)</source>
        <translation>{}: ist nicht die Adresse einer Datei (https://.../quadrille-...tar.xz)</translation>
    </message>
    <message>
        <source>{}: was cancelled</source>
        <translation>{}: wurde abgebrochen</translation>
    </message>
    <message>
        <source>{}: ended after {} of {} bytes</source>
        <translation>{}: endete nach {} von {} Byte</translation>
    </message>
    <message>
        <source>{}: cannot be downloaded ({})</source>
        <translation>{}: lässt sich nicht herunterladen ({})</translation>
    </message>
    <message>
        <source>{}: is refused: {} would lie outside of its folder</source>
        <translation>{}: wird abgelehnt: {} läge außerhalb des Ordners</translation>
    </message>
    <message>
        <source>{}: is not a bundle of Quadrille</source>
        <translation>{}: ist kein Paket von Quadrille</translation>
    </message>
    <message>
        <source>{}: cannot be written ({})</source>
        <translation>{}: lässt sich nicht beschreiben ({})</translation>
    </message>
    <message>
        <source>{}: is not a bundle of Quadrille: it has no bin/quadrille</source>
        <translation>{}: ist kein Paket von Quadrille: bin/quadrille fehlt darin</translation>
    </message>
    <message>
        <source>{}: cannot be unpacked ({})</source>
        <translation>{}: lässt sich nicht entpacken ({})</translation>
    </message>
    <message>
        <source>{}: Element {} needs a mesh of second order: set its order, and mesh again</source>
        <translation>{}: das Element {} braucht ein Netz zweiter Ordnung: die Ordnung setzen und neu vernetzen</translation>
    </message>
    <message>
        <source>{}: Element {} needs a mesh of first order: set its order, and mesh again</source>
        <translation>{}: das Element {} braucht ein Netz erster Ordnung: die Ordnung setzen und neu vernetzen</translation>
    </message>
    <message>
        <source>{}: Element {} needs a part in the plane z = 0, and this one leaves it by {} mm: move or rotate it there</source>
        <translation>{}: das Element {} braucht ein Teil in der Ebene z = 0, und dieses weicht um {} mm davon ab: es dorthin verschieben oder drehen</translation>
    </message>
    <message>
        <source>{}: Element {} has the y axis as its axis of symmetry, and the part reaches to x = {} mm: move it to positive x</source>
        <translation>{}: das Element {} hat die y-Achse als Symmetrieachse, und das Teil reicht bis x = {} mm: es zu positivem x verschieben</translation>
    </message>
    <message>
        <source>elements are written as {} (its property Element)</source>
        <translation>Elemente werden als {} geschrieben (Eigenschaft Element)</translation>
    </message>
    <message>
        <source>shells are written as S8R, which is better than S8 where they are thin (its property ReducedShells)</source>
        <translation>Schalen werden als S8R geschrieben, was bei dünnen besser ist als S8 (Eigenschaft ReducedShells)</translation>
    </message>
    <message>
        <source>shells are written with the offset {} (its property ShellOffset)</source>
        <translation>Schalen werden mit dem Versatz {} geschrieben (Eigenschaft ShellOffset)</translation>
    </message>
    <message>
        <source>{}: shows stresses at the middle of the shell; those of bending are at its surfaces: set {} of {} to true, and solve again</source>
        <translation>{}: zeigt die Spannungen in der Mitte der Schale; die aus Biegung treten an ihren Oberflächen auf: {} von {} auf wahr setzen und erneut lösen</translation>
    </message>
    <message>
        <source>the search for the middle surface was cancelled</source>
        <translation>die Suche nach der Mittelfläche wurde abgebrochen</translation>
    </message>
    <message>
        <source>There is no analysis. Make one, with CalculiX as its solver, stresses at the surfaces, and steel as its material (to be changed in the tree)?</source>
        <translation>Es gibt keine Analyse. Eine anlegen, mit CalculiX als Löser, Spannungen an den Oberflächen und Stahl als Material (im Baum zu ändern)?</translation>
    </message>
    <message>
        <source>{}: needs an analysis with one CalculiX solver</source>
        <translation>{}: braucht eine Analyse mit einem CalculiX-Löser</translation>
    </message>
    <message>
        <source>CalculiX is not installed</source>
        <translation>CalculiX ist nicht installiert</translation>
    </message>
    <message>
        <source>Solving {}</source>
        <translation>{} wird gelöst</translation>
    </message>
    <message>
        <source>{}: CalculiX gave no results: see the report view</source>
        <translation>{}: CalculiX gab keine Ergebnisse: siehe Ausgabefenster</translation>
    </message>
    <message>
        <source>CalculiX failed; the report view has what it said. {}</source>
        <translation>CalculiX ist gescheitert; was es meldet, steht im Ausgabefenster. {}</translation>
    </message>
</context>
<context>
    <name>QuadrilleSettings</name>
    <message>
        <source>Imprint</source>
        <translation>Verschneiden</translation>
    </message>
    <message>
        <source>First cut parts that touch or cross where they meet, so that they share faces, edges and nodes</source>
        <translation>Teile, die sich berühren oder kreuzen, zuerst dort schneiden, wo sie sich treffen, sodass sie Flächen, Kanten und Knoten gemeinsam haben</translation>
    </message>
    <message>
        <source>Strict</source>
        <translation>Streng</translation>
    </message>
    <message>
        <source>Refuse a face that has no valid mesh on its surface, instead of letting nodes leave it</source>
        <translation>Eine Fläche ablehnen, auf der es kein gültiges Netz gibt, statt Knoten sie verlassen zu lassen</translation>
    </message>
    <message>
        <source>Keep features</source>
        <translation>Feinheiten behalten</translation>
    </message>
    <message>
        <source>1: four-node quads; 2: eight-node quads, better for shells</source>
        <translation>1: Vierecke mit vier Knoten; 2: mit acht Knoten, besser für Schalen</translation>
    </message>
    <message>
        <source>1st</source>
        <translation>1.</translation>
    </message>
    <message>
        <source>2 where a solver reads the mesh: in FreeCAD and in .inp, .unv, .med and .bdf files; else 1</source>
        <translation>2, wo ein Löser das Netz liest: in FreeCAD und in .inp-, .unv-, .med- und .bdf-Dateien; sonst 1</translation>
    </message>
    <message>
        <source>2nd</source>
        <translation>2.</translation>
    </message>
    <message>
        <source>Elements on a full circle of curvature; 0 = curvature is ignored</source>
        <translation>Elemente auf einem vollen Kreis der Krümmung; 0 = ohne Krümmung</translation>
    </message>
    <message>
        <source>Faces</source>
        <translation>Flächen</translation>
    </message>
    <message>
        <source>Faces to mesh, such as Face1,Face7; empty = all faces</source>
        <translation>Zu vernetzende Flächen, etwa Face1,Face7; leer = alle</translation>
    </message>
    <message>
        <source>First join edges of neighboring faces that lie within this length of each other; 0 = not sewn</source>
        <translation>Zuerst Kanten von Nachbarflächen verbinden, die höchstens so weit auseinander liegen; 0 = nicht nähen</translation>
    </message>
    <message>
        <source>Give up after this time; 0 = none</source>
        <translation>Nach dieser Zeit aufgeben; 0 = nie</translation>
    </message>
    <message>
        <source>Give up reading the model after this time; 0 = never</source>
        <translation>Das Lesen nach dieser Zeit aufgeben; 0 = nie</translation>
    </message>
    <message>
        <source>Growth</source>
        <translation>Wachstum</translation>
    </message>
    <message>
        <source>How fast sizes may grow: millimeters of size per millimeter of distance</source>
        <translation>Wie schnell sich die Größe ändern darf: Millimeter Größe je Millimeter Weg</translation>
    </message>
    <message>
        <source>Keep what could be meshed if a face fails</source>
        <translation>Behalten, was vernetzt werden konnte, wenn eine Fläche misslingt</translation>
    </message>
    <message>
        <source>Leave out edges that are shorter and faces that are narrower than this length; 0 = all are meshed</source>
        <translation>Kürzere Kanten und schmalere Flächen weglassen; 0 = alle werden vernetzt</translation>
    </message>
    <message>
        <source>Merge tiny</source>
        <translation>Winziges weg</translation>
    </message>
    <message>
        <source>Allow more than 50 million elements and 5 million segments on edges</source>
        <translation>Auch mehr als 50 Millionen Elemente und 5 Millionen Abschnitte auf Kanten vernetzen</translation>
    </message>
    <message>
        <source>Minimum</source>
        <translation>Minimum</translation>
    </message>
    <message>
        <source>No size goes below this, except those given by name or region; 0 = size / 8</source>
        <translation>Keine Größe liegt darunter; 0 = Größe / 8</translation>
    </message>
    <message>
        <source>OpenVDB grid (.vdb) that limits the size</source>
        <translation>OpenVDB-Gitter (.vdb), das die Größe begrenzt</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Ordnung</translation>
    </message>
    <message>
        <source>Partial</source>
        <translation>Teilweise</translation>
    </message>
    <message>
        <source>Per circle</source>
        <translation>Je Kreis</translation>
    </message>
    <message>
        <source>Sew</source>
        <translation>Nähen</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Strategy</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Subdivide: triangles at twice the size are paired and each quad is cut in four; direct: triangles at the size are paired, except on faces where that fails</source>
        <translation>Unterteilen: Dreiecke doppelter Größe, gepaart, jedes Viereck in vier geteilt; direkt: Dreiecke in der Größe, gepaart, außer auf Flächen, wo das scheitert</translation>
    </message>
    <message>
        <source>Target edge length; 0 = a sixtieth of the model&apos;s diagonal</source>
        <translation>Angestrebte Kantenlänge; 0 = ein Sechzigstel der Diagonale des Modells</translation>
    </message>
    <message>
        <source>Number of threads, at most the number of cores; 0 = all cores</source>
        <translation>Threads, höchstens so viele wie Kerne; 0 = alle Kerne</translation>
    </message>
    <message>
        <source>Time limit</source>
        <translation>Zeitgrenze</translation>
    </message>
    <message>
        <source>a sixtieth of the model&apos;s diagonal</source>
        <translation>ein Sechzigstel der Diagonale</translation>
    </message>
    <message>
        <source>all are meshed</source>
        <translation>alle werden vernetzt</translation>
    </message>
    <message>
        <source>all faces</source>
        <translation>alle Flächen</translation>
    </message>
    <message>
        <source>direct</source>
        <translation>direkt</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>not sewn</source>
        <translation>nicht genäht</translation>
    </message>
    <message>
        <source>size / 8</source>
        <translation>Größe / 8</translation>
    </message>
    <message>
        <source>subdivide</source>
        <translation>unterteilen</translation>
    </message>
    <message>
        <source>Across gaps</source>
        <translation>In Engstellen</translation>
    </message>
    <message>
        <source>Chord error</source>
        <translation>Sehnenfehler</translation>
    </message>
    <message>
        <source>Elements across a gap inside a face, between its loops and rims; 0 = any number</source>
        <translation>Elemente quer über eine Engstelle einer Fläche, zwischen ihren Rändern; 0 = beliebig viele</translation>
    </message>
    <message>
        <source>File (.csv) with lines x,y,z,size: points that request a size</source>
        <translation>Datei (.csv) mit Zeilen x,y,z,Größe: Punkte, die eine Größe verlangen</translation>
    </message>
    <message>
        <source>Largest distance of a segment from its curve or surface: a length in mm such as 0.05, or a share of the size such as 2%; empty = any</source>
        <translation>Wie weit ein Segment von seiner Kurve oder Fläche abweichen darf: eine Länge in mm wie 0.05 oder ein Anteil der Größe wie 2%; leer = beliebig</translation>
    </message>
    <message>
        <source>Number of segments on edges, such as Edge4=20; opposite edges of grids get the same number; empty = by size</source>
        <translation>Wie viele Segmente Kanten bekommen, etwa Edge4=20; die ihnen gegenüberliegen, bekommen ebenso viele; leer = nach Größe</translation>
    </message>
    <message>
        <source>Ratio of each segment&apos;s length to that of the one before, such as Edge4=1.2; empty = none</source>
        <translation>Länge jedes Segments einer Kante im Verhältnis zum vorigen, etwa Edge4=1.2; leer = keines</translation>
    </message>
    <message>
        <source>Unit of length of the grid in millimeters, for its coordinates and its sizes</source>
        <translation>Millimeter je Längeneinheit des Gitters, für Orte und Größen</translation>
    </message>
    <message>
        <source>Rings</source>
        <translation>Ringe</translation>
    </message>
    <message>
        <source>Rings of quads around each hole without corners, if there is room for them; 0 = none</source>
        <translation>Ringe von Vierecken um jedes Loch ohne Ecken, wo Platz dafür ist; 0 = keine</translation>
    </message>
    <message>
        <source>Sizes in space: box:x,y,z,x,y,z=SIZE, sphere:x,y,z,r=SIZE, cylinder:x,y,z,x,y,z,r=SIZE, halfspace:x,y,z,nx,ny,nz=SIZE (the side that the direction points to), in mm; SIZE,LENGTH: around the region the size grows to the global one over that length; empty = none</source>
        <translation>Größen im Raum: box:x,y,z,x,y,z=GRÖSSE, sphere:x,y,z,r=GRÖSSE, cylinder:x,y,z,x,y,z,r=GRÖSSE, halfspace:x,y,z,nx,ny,nz=GRÖSSE (wohin die Richtung zeigt), in mm; GRÖSSE,LÄNGE: ringsum wächst die Größe über diese Länge zur globalen; leer = keine</translation>
    </message>
    <message>
        <source>Surface: sizes grow along faces and across their edges, but not across gaps or through walls; space: through air too</source>
        <translation>surface: Größen wachsen entlang der Flächen und über ihre Kanten, nicht über Spalte und durch Wände; space: auch durch die Luft</translation>
    </message>
    <message>
        <source>The same ratio from both ends of an edge to its middle; empty = none</source>
        <translation>Dasselbe von beiden Enden einer Kante zur Mitte; leer = keines</translation>
    </message>
    <message>
        <source>Factor for the sizes in the grid</source>
        <translation>Die Größen des Gitters mal diesem Wert</translation>
    </message>
    <message>
        <source>any</source>
        <translation>beliebig</translation>
    </message>
    <message>
        <source>by size</source>
        <translation>nach Größe</translation>
    </message>
    <message>
        <source>space</source>
        <translation>Raum</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Faces and edges that keep nodes of their own, whatever their size and shape, such as Edge7,Face3; empty = none</source>
        <translation>Flächen und Kanten, die eigene Knoten behalten, wie groß und geformt sie auch sind, etwa Edge7,Face3; leer = keine</translation>
    </message>
    <message>
        <source>Also mesh features below the reach instead of suppressing them, and let no quad cross a smooth edge</source>
        <translation>Auch Formelemente unterhalb der Reichweite vernetzen, statt sie wegzulassen, und kein Viereck eine glatte Kante überqueren lassen</translation>
    </message>
    <message>
        <source>Suppress edges shorter and faces narrower than this length, where that does no harm; 0 = half the minimum size</source>
        <translation>Kanten, die kürzer, und Flächen, die schmaler als diese Länge sind, weglassen, wo es nicht schadet; 0 = die Hälfte der kleinsten Größe</translation>
    </message>
    <message>
        <source>half the minimum size</source>
        <translation>die Hälfte der kleinsten Größe</translation>
    </message>
    <message>
        <source>A place on a face, edge or vertex that gets a node and a group of that node, x,y,z or Name=x,y,z in mm; without a name the groups are Node1, Node2, ...; empty = none</source>
        <translation>Ein Ort auf einer Fläche, Kante oder Ecke, der einen Knoten und eine Gruppe mit diesem Knoten bekommt, x,y,z oder Name=x,y,z in mm; ohne Namen heißen die Gruppen Node1, Node2, ...; leer = keiner</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>Löcher füllen</translation>
    </message>
    <message>
        <source>Leave out holes, pockets and bosses that are no wider than this length; 0 = all are meshed</source>
        <translation>Löcher, Taschen und Zapfen weglassen, die nicht breiter sind als diese Länge; 0 = alle werden vernetzt</translation>
    </message>
    <message>
        <source>Largest length over width of quads in rows over bends, fillets and narrow faces; 1 = squares</source>
        <translation>Größtes Verhältnis von Länge zu Breite der Vierecke in Reihen über Biegungen, Ausrundungen und schmalen Flächen; 1 = Quadrate</translation>
    </message>
</context>
<context>
    <name>QuadrilleStatus</name>
    <message>
        <source>up to date</source>
        <translation>aktuell</translation>
    </message>
    <message>
        <source>not meshed yet</source>
        <translation>noch nicht vernetzt</translation>
    </message>
    <message>
        <source>the part has changed: mesh again</source>
        <translation>das Teil hat sich geändert: neu vernetzen</translation>
    </message>
    <message>
        <source>the settings have changed: mesh again</source>
        <translation>die Einstellungen haben sich geändert: neu vernetzen</translation>
    </message>
    <message>
        <source>the part is gone</source>
        <translation>das Teil ist weg</translation>
    </message>
    <message>
        <source>the part has changed: choose faces, edges, vertices again</source>
        <translation>das Teil hat sich geändert: Flächen, Kanten, Ecken neu wählen</translation>
    </message>
    <message>
        <source>the settings make no sense</source>
        <translation>die Einstellungen ergeben keinen Sinn</translation>
    </message>
    <message>
        <source>made by other means: mesh again</source>
        <translation>auf andere Weise entstanden: neu vernetzen</translation>
    </message>
    <message>
        <source>the part and the settings have changed: mesh again</source>
        <translation>Teil und Einstellungen haben sich geändert: neu vernetzen</translation>
    </message>
    <message>
        <source>StressPeaks</source>
        <translation>StressPeaks</translation>
    </message>
</context>
<context>
    <name>Quadrille_Adapt</name>
    <message>
        <source>Adapt mesh to results</source>
        <translation>Netz an Ergebnisse anpassen</translation>
    </message>
    <message>
        <source>Estimate the error of the stresses in the result of the analysis, and mesh again with sizes that spread it evenly; then solve again</source>
        <translation>Den Fehler der Spannungen im Ergebnis der Analyse schätzen und mit Größen neu vernetzen, die ihn gleichmäßig verteilen; dann neu lösen</translation>
    </message>
</context>
<context>
    <name>Quadrille_Export</name>
    <message>
        <source>Export quad mesh</source>
        <translation>Vierecknetz exportieren</translation>
    </message>
    <message>
        <source>Write the mesh to a file for CalculiX, Gmsh, Salome, ParaView or Nastran, with its sets and groups</source>
        <translation>Das Netz in eine Datei für CalculiX, Gmsh, Salome, ParaView oder Nastran schreiben, mit Mengen und Gruppen</translation>
    </message>
</context>
<context>
    <name>Quadrille_Flip</name>
    <message>
        <source>Flip shell normals</source>
        <translation>Schalennormalen umdrehen</translation>
    </message>
    <message>
        <source>Flip the shell normals of the selected faces (of all faces if none is selected) and mesh again</source>
        <translation>Die Schalennormalen der gewählten Flächen umdrehen (aller, wenn keine gewählt ist); vernetzt neu</translation>
    </message>
</context>
<context>
    <name>Quadrille_Mesh</name>
    <message>
        <source>Quad mesh from shape</source>
        <translation>Vierecknetz aus Form</translation>
    </message>
    <message>
        <source>Mesh the selected part with quads; several parts are joined where they touch</source>
        <translation>Das gewählte Teil mit Vierecken vernetzen; mehrere Teile werden verbunden, wo sie sich berühren</translation>
    </message>
</context>
<context>
    <name>Quadrille_Middle</name>
    <message>
        <source>Middle surface</source>
        <translation>Mittelfläche</translation>
    </message>
    <message>
        <source>Turn a thin part into the surface in its middle, with its thickness in the active analysis; several parts are joined where they touch</source>
        <translation>Aus einem dünnen Teil die Fläche in seiner Mitte machen, mit ihrer Dicke in der aktiven Analyse; mehrere Teile werden verbunden, wo sie sich berühren</translation>
    </message>
</context>
<context>
    <name>Quadrille_Normals</name>
    <message>
        <source>Show shell normals</source>
        <translation>Schalennormalen zeigen</translation>
    </message>
    <message>
        <source>Show the normals of the shell elements as arrows, or hide them again</source>
        <translation>Die Normalen der Schalenelemente als Pfeile zeigen oder wieder verbergen</translation>
    </message>
</context>
<context>
    <name>Quadrille_Quality</name>
    <message>
        <source>Mesh quality</source>
        <translation>Netzqualität</translation>
    </message>
    <message>
        <source>Show the quality of a quad mesh: numbers, histogram, colors, worst elements</source>
        <translation>Die Qualität eines Vierecknetzes zeigen: Zahlen, Histogramm, Farben, schlechteste Elemente</translation>
    </message>
</context>
<context>
    <name>Quadrille_Refine</name>
    <message>
        <source>Refine faces, edges, vertices</source>
        <translation>Flächen, Kanten, Ecken verfeinern</translation>
    </message>
    <message>
        <source>Give the selected faces, edges or vertices a size of their own (a FEM mesh region)</source>
        <translation>Den gewählten Flächen, Kanten oder Ecken eine eigene Größe geben (FEM-Netzbereich)</translation>
    </message>
</context>
<context>
    <name>Quadrille_Solve</name>
    <message>
        <source>Solve</source>
        <translation>Lösen</translation>
    </message>
    <message>
        <source>Solve the analysis of a quad mesh with CalculiX, and show the stresses</source>
        <translation>Die Analyse eines Vierecknetzes mit CalculiX lösen und die Spannungen zeigen</translation>
    </message>
</context>
<context>
    <name>Quadrille_Surface</name>
    <message>
        <source>Quad mesh from mesh</source>
        <translation>Vierecknetz aus Netz</translation>
    </message>
    <message>
        <source>Remesh the selected mesh object, such as a scan or an STL file, with quads</source>
        <translation>Das gewählte Netzobjekt, etwa einen Scan oder eine STL-Datei, neu mit Vierecken vernetzen</translation>
    </message>
</context>
</TS>
