<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr">
<context>
    <name>Quadrille</name>
    <message>
        <source>Mesh again</source>
        <translation>Mailler à nouveau</translation>
    </message>
    <message>
        <source>Mesh all stale meshes again</source>
        <translation>Mailler à nouveau tous les maillages périmés</translation>
    </message>
    <message>
        <source>{}: the estimated error is {} %, below the target: the mesh stays.</source>
        <translation>{} : l’erreur estimée est de {} %, sous celle voulue : le maillage reste.</translation>
    </message>
    <message>
        <source>{}: the estimated error was {} %; now there are {} quads: solve again.</source>
        <translation>{} : l’erreur estimée était de {} % ; il y a maintenant {} quadrangles : recalculer.</translation>
    </message>
    <message>
        <source>Show part / mesh</source>
        <translation>Afficher pièce / maillage</translation>
    </message>
    <message>
        <source>Shows the mesh instead of the part, or the part instead of the mesh</source>
        <translation>Affiche le maillage à la place de la pièce, ou la pièce à la place du maillage</translation>
    </message>
    <message>
        <source>open a document first</source>
        <translation>ouvrez d'abord un document</translation>
    </message>
    <message>
        <source>the document has no quad mesh: select a part and use Quad mesh from shape first</source>
        <translation>le document n'a pas de maillage de quadrangles : sélectionnez d'abord une pièce et utilisez « Maillage de quadrangles »</translation>
    </message>
    <message>
        <source>the document has several quad meshes: select one of them</source>
        <translation>le document a plusieurs maillages de quadrangles : sélectionnez-en un</translation>
    </message>
    <message>
        <source>{}: is not meshed yet: double-click it and press Mesh</source>
        <translation>{} : n'est pas encore maillé : double-cliquez dessus et appuyez sur « Mailler »</translation>
    </message>
    <message>
        <source>Open a document first.</source>
        <translation>Ouvrez d'abord un document.</translation>
    </message>
    <message>
        <source>select one part to mesh, or several</source>
        <translation>sélectionnez une pièce à mailler, ou plusieurs</translation>
    </message>
    <message>
        <source>select faces, edges or vertices of the part first</source>
        <translation>sélectionnez d'abord des faces, arêtes ou sommets de la pièce</translation>
    </message>
    <message>
        <source>Refine</source>
        <translation>Raffiner</translation>
    </message>
    <message>
        <source>Element size</source>
        <translation>Taille des éléments</translation>
    </message>
    <message>
        <source>no face of {} is selected: select its faces, or nothing to flip all of them</source>
        <translation>rien de ce qui est sélectionné n'est une face de {} : sélectionnez ses faces, ou rien pour les retourner toutes</translation>
    </message>
    <message>
        <source>{}: &apos;{}&apos; is not a length, such as 0.5 mm or 1/8 in</source>
        <translation>{} : « {} » n'est pas une longueur comme 0,5 mm ou 1/8 in</translation>
    </message>
    <message>
        <source>General</source>
        <translation>Général</translation>
    </message>
    <message>
        <source>Mesher</source>
        <translation>Mailleur</translation>
    </message>
    <message>
        <source>found automatically</source>
        <translation>trouvée d'elle-même</translation>
    </message>
    <message>
        <source>Path of the quadrille command if it is not on PATH</source>
        <translation>Chemin de la commande quadrille, si elle n'est pas dans PATH</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Commande</translation>
    </message>
    <message>
        <source>Settings of new meshes</source>
        <translation>Les nouveaux maillages débutent avec</translation>
    </message>
    <message>
        <source>Elements, about</source>
        <translation>Éléments, environ</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Fils d'exécution</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aspect visuel</translation>
    </message>
    <message>
        <source>Color a mesh by quality when it is made</source>
        <translation>Colorer un nouveau maillage selon sa qualité</translation>
    </message>
    <message>
        <source>Width of lines</source>
        <translation>Largeur des lignes</translation>
    </message>
    <message>
        <source>The quadrille command</source>
        <translation>La commande quadrille</translation>
    </message>
    <message>
        <source>uses {}</source>
        <translation>utilise {}</translation>
    </message>
    <message>
        <source>q</source>
        <translation>q</translation>
    </message>
    <message>
        <source>Aspect</source>
        <translation>Allongement</translation>
    </message>
    <message>
        <source>Warp</source>
        <translation>Gauchissement</translation>
    </message>
    <message>
        <source>Skew</source>
        <translation>Biais</translation>
    </message>
    <message>
        <source>Smallest angle</source>
        <translation>Angle minimal</translation>
    </message>
    <message>
        <source>Largest angle</source>
        <translation>Angle maximal</translation>
    </message>
    <message>
        <source>Jacobian ratio</source>
        <translation>Rapport jacobien</translation>
    </message>
    <message>
        <source>Taper</source>
        <translation>Trapèze</translation>
    </message>
    <message>
        <source>Criterion</source>
        <translation>Critère</translation>
    </message>
    <message>
        <source>Fail</source>
        <translation>Hors</translation>
    </message>
    <message>
        <source>Worst</source>
        <translation>Pire</translation>
    </message>
    <message>
        <source>Color the mesh</source>
        <translation>Colorer</translation>
    </message>
    <message>
        <source>Blue is good, red is bad; for a criterion, yellow is at its limit</source>
        <translation>Bleu est bon, rouge est mauvais ; pour un critère, jaune est à la limite</translation>
    </message>
    <message>
        <source>Show free sides</source>
        <translation>Montrer les côtés libres</translation>
    </message>
    <message>
        <source>Sides of one element only, and nodes at the same place</source>
        <translation>Côtés d'un seul élément, et nœuds au même endroit</translation>
    </message>
    <message>
        <source>Worst elements (click on one)</source>
        <translation>Pires éléments (cliquez)</translation>
    </message>
    <message>
        <source>Quads</source>
        <translation>Quadrangles</translation>
    </message>
    <message>
        <source>Nodes</source>
        <translation>Nœuds</translation>
    </message>
    <message>
        <source>q: smallest, mean</source>
        <translation>q : min., moyen</translation>
    </message>
    <message>
        <source>Jacobian</source>
        <translation>Jacobien</translation>
    </message>
    <message>
        <source>Irregular nodes</source>
        <translation>Nœuds irréguliers</translation>
    </message>
    <message>
        <source>Outside limits</source>
        <translation>Hors limites</translation>
    </message>
    <message>
        <source>Without warp and short sides, which the table below counts</source>
        <translation>Sans gauchissement ni côtés courts, comptés dans le tableau ci-dessous</translation>
    </message>
    <message>
        <source>Mesher&apos;s time</source>
        <translation>Temps</translation>
    </message>
    <message>
        <source>Quality of {}</source>
        <translation>Qualité de {}</translation>
    </message>
    <message>
        <source>Refine selection</source>
        <translation>Raffiner la sélection</translation>
    </message>
    <message>
        <source>Set the element size on the selected faces, edges or vertices</source>
        <translation>Donner une taille propre aux faces, arêtes ou sommets sélectionnés</translation>
    </message>
    <message>
        <source>Refinement</source>
        <translation>Raffinement</translation>
    </message>
    <message>
        <source>Remove this refinement</source>
        <translation>Supprimer ce raffinement</translation>
    </message>
    <message>
        <source>Quad mesh</source>
        <translation>Maillage de quadrangles</translation>
    </message>
    <message>
        <source>Suggest</source>
        <translation>Proposer</translation>
    </message>
    <message>
        <source>The size that gives about {} elements</source>
        <translation>La taille qui donne environ {} éléments</translation>
    </message>
    <message>
        <source>Mesh only the faces that are selected in the 3-D view</source>
        <translation>Ne mailler que les faces sélectionnées dans la vue 3D</translation>
    </message>
    <message>
        <source>Stresses at the surfaces</source>
        <translation>Contraintes en surface</translation>
    </message>
    <message>
        <source>CalculiX then gives results at the top and bottom of the shell, where bending stresses occur, not only at its middle (the solver&apos;s property Beam Shell Result Output 3D)</source>
        <translation>CalculiX donne alors des résultats en haut et en bas de la coque, où sont les contraintes de flexion, et non seulement en son milieu (propriété « Beam Shell Result Output 3D » du solveur)</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Mailler</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Ends the mesher</source>
        <translation>Arrête le mailleur</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>Pièce</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Attendu</translation>
    </message>
    <message>
        <source>Refinements</source>
        <translation>Raffinements</translation>
    </message>
    <message>
        <source>More settings</source>
        <translation>Autres réglages</translation>
    </message>
    <message>
        <source>about {} quads</source>
        <translation>environ {} quadrangles</translation>
    </message>
    <message>
        <source>Select them on {} in the 3-D view first.</source>
        <translation>Sélectionnez-les d'abord sur {} dans la vue 3D.</translation>
    </message>
    <message>
        <source>meshing</source>
        <translation>maillage</translation>
    </message>
    <message>
        <source>{} quads: mesher {} s, into FreeCAD {} s</source>
        <translation>{} quadrangles : mailleur {} s, vers FreeCAD {} s</translation>
    </message>
    <message>
        <source>Another task panel is open: close it first.</source>
        <translation>Un autre panneau de tâches est ouvert : fermez-le d'abord.</translation>
    </message>
    <message>
        <source>{}: the part that it meshes is gone.</source>
        <translation>{} : la pièce maillée n'existe plus.</translation>
    </message>
    <message>
        <source>Get the mesher</source>
        <translation>Obtenir le mailleur</translation>
    </message>
    <message>
        <source>Use the one on PATH</source>
        <translation>Prendre celui du PATH</translation>
    </message>
    <message>
        <source>There is no command quadrille on PATH</source>
        <translation>Il n’y a pas de commande quadrille dans le PATH</translation>
    </message>
    <message>
        <source>Use a bundle file ...</source>
        <translation>Prendre le fichier d’une archive…</translation>
    </message>
    <message>
        <source>Download</source>
        <translation>Télécharger</translation>
    </message>
    <message>
        <source>A bundle is unpacked into {}, tested, and entered in the preferences. Nothing else is changed.</source>
        <translation>Une archive est extraite dans {}, essayée, puis indiquée dans les préférences. Rien d’autre n’est modifié.</translation>
    </message>
    <message>
        <source>Install it</source>
        <translation>Installer</translation>
    </message>
    <message>
        <source>A bundle of Quadrille</source>
        <translation>Une archive de Quadrille</translation>
    </message>
    <message>
        <source>downloading {}</source>
        <translation>téléchargement de {}</translation>
    </message>
    <message>
        <source>unpacking {}</source>
        <translation>extraction de {}</translation>
    </message>
    <message>
        <source>{} has the SHA-256
{}
Compare it with the one published with the file. Installing unpacks it into {} and runs it.</source>
        <translation>{} a la SHA-256
{}
Comparez-la avec celle publiée à côté du fichier. L’installation l’extrait dans {} et l’exécute.</translation>
    </message>
    <message>
        <source>select one thin part, or several that touch</source>
        <translation>sélectionnez une pièce mince, ou plusieurs qui se touchent</translation>
    </message>
    <message>
        <source>{}. Use the walls that could be paired?</source>
        <translation>{}. Prendre ce qui a pu être apparié ?</translation>
    </message>
    <message>
        <source>{} are on {}. Move them to its middle surface?</source>
        <translation>{} portent sur {}. Les reporter sur sa surface moyenne ?</translation>
    </message>
    <message>
        <source>{} may be a thin solid, of about {} mm: a mesh of its skin is a hollow box, and shell stresses on it are meaningless.</source>
        <translation>{} est peut-être un solide mince d’environ {} mm : sa peau est alors une boîte creuse, et des contraintes de coque y sont dépourvues de sens.</translation>
    </message>
    <message>
        <source>Make its middle surface</source>
        <translation>Créer sa surface moyenne</translation>
    </message>
    <message>
        <source>select one mesh object, such as an STL file that was imported</source>
        <translation>sélectionnez un objet maillage, par exemple un fichier STL importé</translation>
    </message>
    <message>
        <source>{}: the mesh object that it meshes is gone</source>
        <translation>{} : l’objet maillage qu’il maille n’existe plus</translation>
    </message>
    <message>
        <source>Quad mesh of {}</source>
        <translation>Maillage de quadrangles de {}</translation>
    </message>
    <message>
        <source>{}: its normals are those of {}: flip them there (Meshes, Flip normals), and mesh again</source>
        <translation>{} : ses normales sont celles de {} : retournez-les là (Maillages, Inverser les normales), puis maillez à nouveau</translation>
    </message>
    <message>
        <source>none: one face</source>
        <translation>aucun : une seule face</translation>
    </message>
    <message>
        <source>Finding the middle surface of {}...</source>
        <translation>Recherche de la surface moyenne de {}…</translation>
    </message>
    <message>
        <source>Meshing {}...</source>
        <translation>Maillage de {}…</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>the element size must be larger than 0</source>
        <translation>la taille d’élément doit être supérieure à 0</translation>
    </message>
    <message>
        <source>Element order</source>
        <translation>Ordre des éléments</translation>
    </message>
    <message>
        <source>New face from a fold of</source>
        <translation>Nouvelle face à partir d’un pli de</translation>
    </message>
    <message>
        <source>Merge nodes closer than</source>
        <translation>Fusionner les nœuds plus proches que</translation>
    </message>
    <message>
        <source>Adapting {}</source>
        <translation>Adaptation de {}</translation>
    </message>
    <message>
        <source>Adapt {} to results</source>
        <translation>Adapter {} aux résultats</translation>
    </message>
    <message>
        <source>Target error of the stresses, percent</source>
        <translation>Erreur voulue sur les contraintes, pour cent</translation>
    </message>
    <message>
        <source>{} of {}: give its numbers, or remove it</source>
        <translation>{} de {} : indiquez ses nombres ou supprimez-le</translation>
    </message>
    <message>
        <source>Preview sizes</source>
        <translation>Aperçu des tailles</translation>
    </message>
    <message>
        <source>Show the element sizes in colors, and what requests them, before meshing</source>
        <translation>Montrer en couleurs, avant de mailler, la taille qu'auraient les éléments et ce qui la demande</translation>
    </message>
    <message>
        <source>finding sizes</source>
        <translation>recherche des tailles</translation>
    </message>
    <message>
        <source>finding sizes: {} %</source>
        <translation>recherche des tailles : {} %</translation>
    </message>
    <message>
        <source>dark {} mm, light {} mm</source>
        <translation>foncé {} mm, clair {} mm</translation>
    </message>
    <message>
        <source>bends: size across them; quads are up to {} times as long</source>
        <translation>plis : taille en travers ; les quadrangles sont jusqu’à {} fois plus longs</translation>
    </message>
    <message>
        <source>{}: {:.0f} quads on {} % of the area</source>
        <translation>{} : {:.0f} quadrangles sur {} % de l'aire</translation>
    </message>
    <message>
        <source>Follow results</source>
        <translation>Suivre les résultats</translation>
    </message>
    <message>
        <source>Divide selected edges</source>
        <translation>Diviser les arêtes choisies</translation>
    </message>
    <message>
        <source>Set the number of elements on the selected edges</source>
        <translation>Dire combien d’éléments les arêtes choisies reçoivent</translation>
    </message>
    <message>
        <source>Expected by face</source>
        <translation>Attendus par face</translation>
    </message>
    <message>
        <source>{} has no {}</source>
        <translation>{} n'a pas de {}</translation>
    </message>
    <message>
        <source>Shortest side</source>
        <translation>Côté minimal</translation>
    </message>
    <message>
        <source>Nodes at selected points</source>
        <translation>Nœuds aux points choisis</translation>
    </message>
    <message>
        <source>Put a node, with a group of its own, at each selected vertex or point object</source>
        <translation>Place un nœud, avec son propre groupe, à chaque sommet ou objet point sélectionné</translation>
    </message>
    <message>
        <source>Select vertices or points in the 3-D view or the tree first.</source>
        <translation>Sélectionnez d'abord des sommets ou des points dans la vue 3D ou dans l'arborescence.</translation>
    </message>
    <message>
        <source>Refine here</source>
        <translation>Affiner ici</translation>
    </message>
    <message>
        <source>Element {} on {}: q {}, aspect {}, angles {} to {} degrees</source>
        <translation>Élément {} sur {} : q {}, allongement {}, angles de {} à {} degrés</translation>
    </message>
    <message>
        <source>forced by {}</source>
        <translation>imposé par {}</translation>
    </message>
    <message>
        <source>the mesh is not in an analysis: drag it into one in the tree</source>
        <translation>le maillage n'est dans aucune analyse : le glisser dans une analyse de l'arborescence</translation>
    </message>
    <message>
        <source>its analysis is not the active one: double-click it</source>
        <translation>son analyse n'est pas l'analyse active : double-cliquer dessus</translation>
    </message>
    <message>
        <source>the analysis has no material</source>
        <translation>l'analyse n'a pas de matériau</translation>
    </message>
    <message>
        <source>the analysis has no shell thickness (Model &gt; Element geometry)</source>
        <translation>l'analyse n'a pas d'épaisseur de coque (Modèle &gt; Géométrie d'élément)</translation>
    </message>
    <message>
        <source>the mesh is in pieces that share no nodes: Imprint or Sew joins parts that touch</source>
        <translation>le maillage est en morceaux sans nœud commun : Imprimer ou Coudre relie ce qui se touche</translation>
    </message>
    <message>
        <source>stresses come from the middle of the shell only: tick Stresses at the surfaces</source>
        <translation>les contraintes viennent du seul milieu de la coque : Contraintes en surface</translation>
    </message>
    <message>
        <source>Missing before solving: {}</source>
        <translation>Il manque avant le calcul : {}</translation>
    </message>
    <message>
        <source>Nothing is missing before solving</source>
        <translation>Rien ne manque avant le calcul</translation>
    </message>
    <message>
        <source>waits until the open panel or command has ended</source>
        <translation>attend la fin du panneau ou de la commande en cours</translation>
    </message>
    <message>
        <source>{}: {} quads</source>
        <translation>{} : {} quadrangles</translation>
    </message>
    <message>
        <source>Finding a size</source>
        <translation>Recherche d’une taille</translation>
    </message>
    <message>
        <source>{}: not meshed, since its panel was closed</source>
        <translation>{} : non maillé, car son panneau a été fermé</translation>
    </message>
    <message>
        <source>plane stress</source>
        <translation>contraintes planes</translation>
    </message>
    <message>
        <source>plane strain</source>
        <translation>déformations planes</translation>
    </message>
    <message>
        <source>rotational symmetry</source>
        <translation>symétrie de révolution</translation>
    </message>
    <message>
        <source>membrane</source>
        <translation>membrane</translation>
    </message>
    <message>
        <source>shell</source>
        <translation>coque</translation>
    </message>
    <message>
        <source>four nodes</source>
        <translation>quatre nœuds</translation>
    </message>
    <message>
        <source>eight nodes</source>
        <translation>huit nœuds</translation>
    </message>
    <message>
        <source>reduced integration</source>
        <translation>intégration réduite</translation>
    </message>
    <message>
        <source>full integration</source>
        <translation>intégration complète</translation>
    </message>
    <message>
        <source>S4 at first order; S8R, with reduced integration, at second</source>
        <translation>S4 au premier ordre ; S8R, à intégration réduite, au second</translation>
    </message>
    <message>
        <source>Type of the elements for CalculiX; those for planes and rotational symmetry need a part in the plane z = 0</source>
        <translation>Type des éléments pour CalculiX ; ceux des plans et de la symétrie de révolution demandent une pièce dans le plan z = 0</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Moy.</translation>
    </message>
    <message>
        <source>reading the part</source>
        <translation>lecture de la pièce</translation>
    </message>
    <message>
        <source>finding the middle surface</source>
        <translation>recherche de la surface moyenne</translation>
    </message>
    <message>
        <source>dividing edges</source>
        <translation>division des arêtes</translation>
    </message>
    <message>
        <source>meshing faces</source>
        <translation>maillage des faces</translation>
    </message>
    <message>
        <source>making triangles</source>
        <translation>création des triangles</translation>
    </message>
    <message>
        <source>pairing triangles</source>
        <translation>appariement des triangles</translation>
    </message>
    <message>
        <source>making quads</source>
        <translation>création des quadrangles</translation>
    </message>
    <message>
        <source>improving quads</source>
        <translation>amélioration des quadrangles</translation>
    </message>
    <message>
        <source>moving nodes</source>
        <translation>déplacement des nœuds</translation>
    </message>
    <message>
        <source>joining faces</source>
        <translation>assemblage des faces</translation>
    </message>
    <message>
        <source>writing the mesh</source>
        <translation>écriture du maillage</translation>
    </message>
    <message>
        <source>From selection</source>
        <translation>Sélection</translation>
    </message>
    <message>
        <source>Elements</source>
        <translation>Éléments</translation>
    </message>
    <message>
        <source>Half the size of the element, in a ball three elements wide around it</source>
        <translation>La moitié de la taille de l'élément, dans une boule large de trois éléments autour de lui</translation>
    </message>
    <message>
        <source>refined where asked: the smallest q fell from {} to {}</source>
        <translation>affiné à l'endroit voulu : le q minimal est passé de {} à {}</translation>
    </message>
    <message>
        <source>Hidden in it, and not meshed: {}</source>
        <translation>Cachés dedans, et non maillés : {}</translation>
    </message>
    <message>
        <source>{} has {} solids that touch or cross. Join them there (Imprint), so that they share nodes?</source>
        <translation>{} a {} solides qui se touchent ou se coupent. Les relier là (Imprimer), pour qu'ils partagent des nœuds ?</translation>
    </message>
    <message>
        <source>tiny: replaced by an edge or a node of its neighbors</source>
        <translation>minuscule : une arête ou un nœud de ses voisines la remplace</translation>
    </message>
    <message>
        <source>in a filled hole</source>
        <translation>dans un trou rempli</translation>
    </message>
    <message>
        <source>joined with {}: coplanar</source>
        <translation>réunie avec {} : coplanaires</translation>
    </message>
    <message>
        <source>joined with {}: facets</source>
        <translation>réunie avec {} : facettes</translation>
    </message>
    <message>
        <source>crossed: covered by quads whose centers lie on its neighbors</source>
        <translation>traversée : couverte par des quadrangles dont les centres sont sur ses voisines</translation>
    </message>
    <message>
        <source>no edge or angle there is too small; the mesh itself is irregular there</source>
        <translation>aucune arête ni aucun angle n'y est trop petit ; le maillage lui-même y est irrégulier</translation>
    </message>
    <message>
        <source>small, but meshed: {}</source>
        <translation>petite, mais maillée : {}</translation>
    </message>
    <message>
        <source>boss on {} that is left out</source>
        <translation>bossage sur {} laissé de côté</translation>
    </message>
    <message>
        <source>hole in {} that is filled</source>
        <translation>trou rempli dans {}</translation>
    </message>
    <message>
        <source>too small: {} stands for it</source>
        <translation>trop petit : {} le remplace</translation>
    </message>
    <message>
        <source>poor quads: {}; {}</source>
        <translation>mauvais quadrangles : {} ; {}</translation>
    </message>
    <message>
        <source>smooth edge that quads cross; on {}</source>
        <translation>arête lisse que des quadrangles traversent ; sur {}</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Où</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Quoi</translation>
    </message>
    <message>
        <source>Of what is suppressed: how far it lies from what stands for it; of an edge that quads cross: how far it lies from them; of a filled hole: its width; of poor quads: their shortest side</source>
        <translation>Pour ce qui est supprimé : sa distance à ce qui le remplace ; pour une arête traversée : sa distance aux quadrangles ; pour un trou rempli : sa largeur ; pour de mauvais quadrangles : leur plus petit côté</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Garder</translation>
    </message>
    <message>
        <source>Size in</source>
        <translation>Taille dans</translation>
    </message>
    <message>
        <source>Segments</source>
        <translation>Segments</translation>
    </message>
    <message>
        <source>Bias</source>
        <translation>Progression</translation>
    </message>
    <message>
        <source>Bias from both ends</source>
        <translation>Progression depuis les deux bouts</translation>
    </message>
    <message>
        <source>Node</source>
        <translation>Nœud</translation>
    </message>
    <message>
        <source>In the next mesh, the faces and edges selected here or in the 3-D view keep nodes of their own</source>
        <translation>Dans le prochain maillage, les faces et arêtes sélectionnées ici ou dans la vue 3D gardent leurs propres nœuds</translation>
    </message>
    <message>
        <source>Suppress</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>The selected faces and edges are no longer kept: where they are small, they may be suppressed or crossed in the next mesh</source>
        <translation>Les faces et arêtes sélectionnées ne sont plus gardées : là où elles sont petites, elles peuvent être supprimées ou traversées dans le prochain maillage</translation>
    </message>
    <message>
        <source>to be kept</source>
        <translation>à garder</translation>
    </message>
    <message>
        <source>it is {} long</source>
        <translation>sa longueur est {}</translation>
    </message>
    <message>
        <source>its sides meet at {} degrees at {}</source>
        <translation>ses côtés font {} degrés en {}</translation>
    </message>
    <message>
        <source>{} comes within {} of itself</source>
        <translation>{} s'approche d'elle-même à {}</translation>
    </message>
    <message>
        <source>{} and {} come within {} of each other</source>
        <translation>{} et {} s'approchent à {}</translation>
    </message>
    <message>
        <source>a loop of {} would be too small for elements</source>
        <translation>une boucle de {} serait trop petite pour des éléments</translation>
    </message>
    <message>
        <source>{} is so narrow that it would lose much of its area</source>
        <translation>{} est si étroite qu'elle perdrait une grande part de son aire</translation>
    </message>
    <message>
        <source>two edges of {} would share their nodes</source>
        <translation>deux arêtes de {} partageraient leurs nœuds</translation>
    </message>
    <message>
        <source>a node is placed at its boundary</source>
        <translation>un nœud est placé sur son bord</translation>
    </message>
    <message>
        <source>its long sides are not everywhere close together</source>
        <translation>ses longs côtés ne sont pas partout proches</translation>
    </message>
    <message>
        <source>{} has no valid mesh without it</source>
        <translation>{} n'a pas de maillage valable sans elle</translation>
    </message>
    <message>
        <source>{} more that do less harm</source>
        <translation>{} autres, moins nuisibles</translation>
    </message>
    <message>
        <source>{}: which face, edge or vertex of {} {} was ({}) cannot be identified since the part was changed: choose it again</source>
        <translation>{} : depuis la modification de la pièce, on ne sait plus quelle face, arête ou sommet de {} était {} ({}) : choisir de nouveau</translation>
    </message>
    <message>
        <source>{}: {} is no longer on its surface</source>
        <translation>{} : {} n'est plus sur sa surface</translation>
    </message>
    <message>
        <source>{}: {}; until then, pick its faces, edges and vertices on the part</source>
        <translation>{} : {} ; en attendant, choisir ses faces, arêtes et sommets sur la pièce</translation>
    </message>
    <message>
        <source>select the faces, edges or vertices to refine</source>
        <translation>sélectionner les faces, arêtes ou sommets à raffiner</translation>
    </message>
    <message>
        <source>a refinement needs a size larger than 0, not {}</source>
        <translation>un raffinement demande une taille supérieure à 0, et non {}</translation>
    </message>
    <message>
        <source>a size of {:.3g} mm is too small for a part of {:.3g} mm</source>
        <translation>une taille de {:.3g} mm est trop petite pour une pièce de {:.3g} mm</translation>
    </message>
    <message>
        <source>a size of {:.3g} mm is larger than the model, whose diagonal is {:.3g} mm</source>
        <translation>une taille de {:.3g} mm dépasse le modèle, dont la diagonale est de {:.3g} mm</translation>
    </message>
    <message>
        <source>{}: the part has no such face to flip</source>
        <translation>{} : la pièce n'a pas cette face à inverser</translation>
    </message>
    <message>
        <source>the normals cannot be flipped: the part has edges or vertices that belong to no face</source>
        <translation>les normales ne peuvent être inversées : la pièce a des arêtes ou sommets sans face</translation>
    </message>
    <message>
        <source>{}.{}: is not in the meshed part</source>
        <translation>{}.{} : n'est pas dans la pièce maillée</translation>
    </message>
    <message>
        <source>Solid{}: is not in the meshed part</source>
        <translation>Solid{} : n'est pas dans la pièce maillée</translation>
    </message>
    <message>
        <source>{}: the part that it meshes is gone</source>
        <translation>{} : la pièce maillée n'existe plus</translation>
    </message>
    <message>
        <source>{}: has no shape to mesh</source>
        <translation>{} : n'a pas de forme à mailler</translation>
    </message>
    <message>
        <source>{}: its shape has no faces to mesh</source>
        <translation>{} : sa forme n'a pas de faces à mailler</translation>
    </message>
    <message>
        <source>{}: a mesh region needs a length larger than 0</source>
        <translation>{} : une région de maillage demande une longueur supérieure à 0</translation>
    </message>
    <message>
        <source>{}: its sizes from results cannot be read ({}): switch {} off</source>
        <translation>{} : ses tailles tirées des résultats sont illisibles ({}) : désactiver {}</translation>
    </message>
    <message>
        <source>{}: its SizeField is set, which the sizes from results would replace: clear it first</source>
        <translation>{} : SizeField est défini, et les tailles tirées des résultats le remplaceraient : l'effacer d'abord</translation>
    </message>
    <message>
        <source>{}: is not in an analysis: add it to one, and solve that first</source>
        <translation>{} : n'est dans aucune analyse : l'ajouter à une analyse, et la résoudre d'abord</translation>
    </message>
    <message>
        <source>{}: has no result with displacements: solve it with {} first</source>
        <translation>{} : n'a pas de résultat avec déplacements : résoudre d'abord avec {}</translation>
    </message>
    <message>
        <source>{}: its nodes are displaced: set DisplaceMesh of {} to false, and solve again</source>
        <translation>{} : ses nœuds sont déplacés : mettre DisplaceMesh de {} à false, et résoudre de nouveau</translation>
    </message>
    <message>
        <source>{}: has results at the middle of the shell only: set {} of {} to true, and solve again</source>
        <translation>{} : n'a de résultats qu'au milieu de la coque : mettre {} de {} à true, et résoudre de nouveau</translation>
    </message>
    <message>
        <source>{}: has no shell elements: an element has {} nodes</source>
        <translation>{} : n'a pas d'éléments coques : un élément a {} nœuds</translation>
    </message>
    <message>
        <source>{}: has no displacements: solve again</source>
        <translation>{} : n'a pas de déplacements : résoudre de nouveau</translation>
    </message>
    <message>
        <source>{}: is being meshed already; wait for it, or cancel it first</source>
        <translation>{} : est déjà en cours de maillage ; attendre, ou l'annuler d'abord</translation>
    </message>
    <message>
        <source>{}: has no face {} to flip</source>
        <translation>{} : n'a pas de face {} à inverser</translation>
    </message>
    <message>
        <source>{}: {}; nothing was exported</source>
        <translation>{} : {} ; rien n'a été exporté</translation>
    </message>
    <message>
        <source>{}: the mesher now gives another mesh (its version has changed, or the part was recomputed and differs by rounding): mesh again, then export</source>
        <translation>{} : le mailleur donne maintenant un autre maillage (sa version a changé, ou la pièce recalculée diffère par les arrondis) : mailler de nouveau, puis exporter</translation>
    </message>
    <message>
        <source>{}: cannot be written: {}</source>
        <translation>{} : ne peut être écrit : {}</translation>
    </message>
    <message>
        <source>{}: is not a FEM analysis</source>
        <translation>{} : n'est pas une analyse FEM</translation>
    </message>
    <message>
        <source>{}: already holds the mesh {}, and FreeCAD solves with one mesh only</source>
        <translation>{} : contient déjà le maillage {}, et FreeCAD ne résout qu'avec un seul</translation>
    </message>
    <message>
        <source>{}: has no solid; a middle surface is made of solids</source>
        <translation>{} : n'a pas de solide ; une surface moyenne se fait à partir de solides</translation>
    </message>
    <message>
        <source>{}: is not a mesh object; select one, such as an STL file that was imported</source>
        <translation>{} : n'est pas un objet maillage ; en sélectionner un, comme un fichier STL importé</translation>
    </message>
    <message>
        <source>{}: has no triangles to mesh</source>
        <translation>{} : n'a pas de triangles à mailler</translation>
    </message>
    <message>
        <source>{}: cannot be meshed at size {:g}: it must be larger than 0</source>
        <translation>{} : ne peut être maillé à la taille {:g} : elle doit être supérieure à 0</translation>
    </message>
    <message>
        <source>{}: its {} faces need more than {}, unless elements are larger than a tenth of the part</source>
        <translation>{} : ses {} faces en demandent plus de {}, sauf si les éléments dépassent un dixième de la pièce</translation>
    </message>
    <message>
        <source>{}: not on the list of what is to be kept; the table says why the mesher itself keeps an edge</source>
        <translation>{} : ne figure pas dans la liste de ce qui est à garder ; le tableau dit pourquoi le mailleur garde lui-même une arête</translation>
    </message>
    <message>
        <source>the folder for temporary files</source>
        <translation>le dossier des fichiers temporaires</translation>
    </message>
    <message>
        <source>{}: no temporary folder can be made there ({}); set the environment variable TMPDIR to a folder that can be written</source>
        <translation>{} : impossible d’y créer un dossier temporaire ({}) ; donner à la variable d’environnement TMPDIR un dossier accessible en écriture</translation>
    </message>
    <message>
        <source>flatpak-spawn: cannot run programs outside of Flatpak ({}); allow it with &apos;flatpak override --user --talk-name=org.freedesktop.Flatpak org.freecad.FreeCAD&apos;</source>
        <translation>flatpak-spawn : impossible de lancer des programmes hors de Flatpak ({}) ; l’autoriser par 'flatpak override --user --talk-name=org.freedesktop.Flatpak org.freecad.FreeCAD'</translation>
    </message>
    <message>
        <source>the argument &apos;command&apos;</source>
        <translation>l’argument 'command'</translation>
    </message>
    <message>
        <source>the environment variable QUADRILLE_COMMAND</source>
        <translation>la variable d’environnement QUADRILLE_COMMAND</translation>
    </message>
    <message>
        <source>the preference &apos;Command&apos;</source>
        <translation>la préférence 'Command'</translation>
    </message>
    <message>
        <source>{}: cannot be run, though {} names it as the mesher</source>
        <translation>{} : ne peut pas être exécuté, bien que {} le désigne comme mailleur</translation>
    </message>
    <message>
        <source>the command &apos;quadrille&apos; is not on PATH; install it, or name its path in the environment variable QUADRILLE_COMMAND or in the preference Mod/Quadrille/Command</source>
        <translation>la commande 'quadrille' n’est pas dans PATH ; l’installer, ou donner son chemin dans la variable d’environnement QUADRILLE_COMMAND ou dans la préférence Mod/Quadrille/Command</translation>
    </message>
    <message>
        <source>{}: does not print its version ({}); install Quadrille {}</source>
        <translation>{} : n’affiche pas sa version ({}) ; installer Quadrille {}</translation>
    </message>
    <message>
        <source>{}: is not the quadrille command; install Quadrille {}, or correct the preference Mod/Quadrille/Command</source>
        <translation>{} : n’est pas la commande quadrille ; installer Quadrille {}, ou corriger la préférence Mod/Quadrille/Command</translation>
    </message>
    <message>
        <source>{}: is of version {}, and this addon needs {}; install the two from one release</source>
        <translation>{} : est de version {}, et cette extension demande {} ; installer les deux de la même version</translation>
    </message>
    <message>
        <source>the work was cancelled</source>
        <translation>le travail a été annulé</translation>
    </message>
    <message>
        <source>{}: cannot be started: {}</source>
        <translation>{} : ne peut pas être lancé : {}</translation>
    </message>
    <message>
        <source>the mesher was killed by signal {}</source>
        <translation>le mailleur a été tué par le signal {}</translation>
    </message>
    <message>
        <source>the meshing was cancelled</source>
        <translation>le maillage a été annulé</translation>
    </message>
    <message>
        <source>the mesher ended with exit code {}</source>
        <translation>le mailleur s’est terminé avec le code {}</translation>
    </message>
    <message>
        <source>FreeCAD read {} of the {} quads that {} wrote</source>
        <translation>FreeCAD a lu {} des {} quadrangles écrits par {}</translation>
    </message>
    <message>
        <source>the shape has no faces to mesh</source>
        <translation>la forme n’a pas de faces à mailler</translation>
    </message>
    <message>
        <source>{}: cannot be read ({})</source>
        <translation>{} : ne peut pas être lu ({})</translation>
    </message>
    <message>
        <source>{}: is not the address of a file (https://.../quadrille-...tar.xz)</source>
        <translation>{} : n’est pas l’adresse d’un fichier (https://.../quadrille-...tar.xz)</translation>
    </message>
    <message>
        <source>{}: was cancelled</source>
        <translation>{} : annulé</translation>
    </message>
    <message>
        <source>{}: ended after {} of {} bytes</source>
        <translation>{} : s’est arrêté après {} octets sur {}</translation>
    </message>
    <message>
        <source>{}: cannot be downloaded ({})</source>
        <translation>{} : ne peut pas être téléchargé ({})</translation>
    </message>
    <message>
        <source>{}: is refused: {} would lie outside of its folder</source>
        <translation>{} : refusé : {} se trouverait hors de son dossier</translation>
    </message>
    <message>
        <source>{}: is not a bundle of Quadrille</source>
        <translation>{} : n’est pas un paquet de Quadrille</translation>
    </message>
    <message>
        <source>{}: cannot be written ({})</source>
        <translation>{} : ne peut pas être écrit ({})</translation>
    </message>
    <message>
        <source>{}: is not a bundle of Quadrille: it has no bin/quadrille</source>
        <translation>{} : n’est pas un paquet de Quadrille : il n’a pas de bin/quadrille</translation>
    </message>
    <message>
        <source>{}: cannot be unpacked ({})</source>
        <translation>{} : ne peut pas être décompressé ({})</translation>
    </message>
    <message>
        <source>{}: Element {} needs a mesh of second order: set its order, and mesh again</source>
        <translation>{} : l’élément {} demande un maillage du second ordre : régler son ordre et mailler à nouveau</translation>
    </message>
    <message>
        <source>{}: Element {} needs a mesh of first order: set its order, and mesh again</source>
        <translation>{} : l’élément {} demande un maillage du premier ordre : régler son ordre et mailler à nouveau</translation>
    </message>
    <message>
        <source>{}: Element {} needs a part in the plane z = 0, and this one leaves it by {} mm: move or rotate it there</source>
        <translation>{} : l’élément {} demande une pièce dans le plan z = 0, et celle-ci s’en écarte de {} mm : l’y déplacer ou l’y tourner</translation>
    </message>
    <message>
        <source>{}: Element {} has the y axis as its axis of symmetry, and the part reaches to x = {} mm: move it to positive x</source>
        <translation>{} : l’élément {} a l’axe y pour axe de symétrie, et la pièce va jusqu’à x = {} mm : la déplacer vers les x positifs</translation>
    </message>
    <message>
        <source>elements are written as {} (its property Element)</source>
        <translation>les éléments sont écrits comme {} (sa propriété Element)</translation>
    </message>
    <message>
        <source>shells are written as S8R, which is better than S8 where they are thin (its property ReducedShells)</source>
        <translation>les coques sont écrites comme S8R, mieux que S8 là où elles sont minces (sa propriété ReducedShells)</translation>
    </message>
    <message>
        <source>shells are written with the offset {} (its property ShellOffset)</source>
        <translation>les coques sont écrites avec le décalage {} (sa propriété ShellOffset)</translation>
    </message>
    <message>
        <source>{}: shows stresses at the middle of the shell; those of bending are at its surfaces: set {} of {} to true, and solve again</source>
        <translation>{} : montre les contraintes au milieu de la coque ; celles de flexion sont à ses surfaces : mettre {} de {} à vrai et résoudre à nouveau</translation>
    </message>
    <message>
        <source>the search for the middle surface was cancelled</source>
        <translation>la recherche de la surface moyenne a été annulée</translation>
    </message>
    <message>
        <source>There is no analysis. Make one, with CalculiX as its solver, stresses at the surfaces, and steel as its material (to be changed in the tree)?</source>
        <translation>Il n’y a pas d’analyse. En créer une, avec CalculiX comme solveur, les contraintes aux surfaces et l’acier comme matériau (à modifier dans l’arborescence) ?</translation>
    </message>
    <message>
        <source>{}: needs an analysis with one CalculiX solver</source>
        <translation>{} : nécessite une analyse avec un seul solveur CalculiX</translation>
    </message>
    <message>
        <source>CalculiX is not installed</source>
        <translation>CalculiX n’est pas installé</translation>
    </message>
    <message>
        <source>Solving {}</source>
        <translation>Résolution de {}</translation>
    </message>
    <message>
        <source>{}: CalculiX gave no results: see the report view</source>
        <translation>{} : CalculiX n’a donné aucun résultat : voir la vue rapport</translation>
    </message>
    <message>
        <source>CalculiX failed; the report view has what it said. {}</source>
        <translation>CalculiX a échoué ; la vue rapport contient ses messages. {}</translation>
    </message>
</context>
<context>
    <name>QuadrilleSettings</name>
    <message>
        <source>Imprint</source>
        <translation>Imprimer</translation>
    </message>
    <message>
        <source>First cut parts that touch or cross where they meet, so that they share faces, edges and nodes</source>
        <translation>Couper d’abord les pièces qui se touchent ou se croisent là où elles se rencontrent, pour qu’elles partagent faces, arêtes et nœuds</translation>
    </message>
    <message>
        <source>Strict</source>
        <translation>Strict</translation>
    </message>
    <message>
        <source>Refuse a face that has no valid mesh on its surface, instead of letting nodes leave it</source>
        <translation>Refuser une face qui n’a pas de maillage valide sur sa surface, au lieu de laisser des nœuds la quitter</translation>
    </message>
    <message>
        <source>Keep features</source>
        <translation>Garder les détails</translation>
    </message>
    <message>
        <source>1: four-node quads; 2: eight-node quads, better for shells</source>
        <translation>1 : quadrangles à quatre nœuds ; 2 : à huit nœuds, meilleurs pour les coques</translation>
    </message>
    <message>
        <source>1st</source>
        <translation>1er</translation>
    </message>
    <message>
        <source>2 where a solver reads the mesh: in FreeCAD and in .inp, .unv, .med and .bdf files; else 1</source>
        <translation>2 là où un solveur lit le maillage : dans FreeCAD et les fichiers .inp, .unv, .med et .bdf ; sinon 1</translation>
    </message>
    <message>
        <source>2nd</source>
        <translation>2e</translation>
    </message>
    <message>
        <source>Elements on a full circle of curvature; 0 = curvature is ignored</source>
        <translation>Éléments sur un cercle complet de courbure ; 0 = courbure ignorée</translation>
    </message>
    <message>
        <source>Faces</source>
        <translation>Faces</translation>
    </message>
    <message>
        <source>Faces to mesh, such as Face1,Face7; empty = all faces</source>
        <translation>Faces à mailler, comme Face1,Face7 ; vide = toutes</translation>
    </message>
    <message>
        <source>First join edges of neighboring faces that lie within this length of each other; 0 = not sewn</source>
        <translation>Joindre d'abord les arêtes de faces voisines distantes d'au plus cette longueur ; 0 = pas de couture</translation>
    </message>
    <message>
        <source>Give up after this time; 0 = none</source>
        <translation>Abandonner après ce temps ; 0 = jamais</translation>
    </message>
    <message>
        <source>Give up reading the model after this time; 0 = never</source>
        <translation>Abandonner la lecture après ce temps ; 0 = jamais</translation>
    </message>
    <message>
        <source>Growth</source>
        <translation>Croissance</translation>
    </message>
    <message>
        <source>How fast sizes may grow: millimeters of size per millimeter of distance</source>
        <translation>À quelle vitesse la taille peut changer : millimètres de taille par millimètre de chemin</translation>
    </message>
    <message>
        <source>Keep what could be meshed if a face fails</source>
        <translation>Garder ce qui a pu être maillé quand une face échoue</translation>
    </message>
    <message>
        <source>Leave out edges that are shorter and faces that are narrower than this length; 0 = all are meshed</source>
        <translation>Omettre les arêtes plus courtes et les faces plus étroites ; 0 = toutes sont maillées</translation>
    </message>
    <message>
        <source>Merge tiny</source>
        <translation>Omettre</translation>
    </message>
    <message>
        <source>Allow more than 50 million elements and 5 million segments on edges</source>
        <translation>Mailler au-delà de 50 millions d'éléments et 5 millions de segments d'arêtes</translation>
    </message>
    <message>
        <source>Minimum</source>
        <translation>Minimum</translation>
    </message>
    <message>
        <source>No size goes below this, except those given by name or region; 0 = size / 8</source>
        <translation>Aucune taille n'est inférieure ; 0 = taille / 8</translation>
    </message>
    <message>
        <source>OpenVDB grid (.vdb) that limits the size</source>
        <translation>Grille OpenVDB (.vdb) qui limite la taille</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Ordre</translation>
    </message>
    <message>
        <source>Partial</source>
        <translation>Partiel</translation>
    </message>
    <message>
        <source>Per circle</source>
        <translation>Par cercle</translation>
    </message>
    <message>
        <source>Sew</source>
        <translation>Coudre</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Taille</translation>
    </message>
    <message>
        <source>Strategy</source>
        <translation>Stratégie</translation>
    </message>
    <message>
        <source>Subdivide: triangles at twice the size are paired and each quad is cut in four; direct: triangles at the size are paired, except on faces where that fails</source>
        <translation>Subdiviser : triangles de taille double, appariés, chaque quadrangle coupé en quatre ; direct : triangles à la taille, appariés, sauf sur les faces où cela échoue</translation>
    </message>
    <message>
        <source>Target edge length; 0 = a sixtieth of the model&apos;s diagonal</source>
        <translation>Longueur d'arête visée ; 0 = un soixantième de la diagonale du modèle</translation>
    </message>
    <message>
        <source>Number of threads, at most the number of cores; 0 = all cores</source>
        <translation>Fils à utiliser, au plus le nombre de cœurs ; 0 = tous les cœurs</translation>
    </message>
    <message>
        <source>Time limit</source>
        <translation>Temps limite</translation>
    </message>
    <message>
        <source>a sixtieth of the model&apos;s diagonal</source>
        <translation>un soixantième de la diagonale</translation>
    </message>
    <message>
        <source>all are meshed</source>
        <translation>toutes sont maillées</translation>
    </message>
    <message>
        <source>all faces</source>
        <translation>toutes les faces</translation>
    </message>
    <message>
        <source>direct</source>
        <translation>direct</translation>
    </message>
    <message>
        <source>none</source>
        <translation>aucun</translation>
    </message>
    <message>
        <source>not sewn</source>
        <translation>pas de couture</translation>
    </message>
    <message>
        <source>size / 8</source>
        <translation>taille / 8</translation>
    </message>
    <message>
        <source>subdivide</source>
        <translation>subdiviser</translation>
    </message>
    <message>
        <source>Across gaps</source>
        <translation>Dans les passages étroits</translation>
    </message>
    <message>
        <source>Chord error</source>
        <translation>Erreur de corde</translation>
    </message>
    <message>
        <source>Elements across a gap inside a face, between its loops and rims; 0 = any number</source>
        <translation>Éléments en travers d’un passage étroit d’une face, entre ses bords ; 0 = n’importe combien</translation>
    </message>
    <message>
        <source>File (.csv) with lines x,y,z,size: points that request a size</source>
        <translation>Fichier (.csv) de lignes x,y,z,taille : points qui demandent une taille</translation>
    </message>
    <message>
        <source>Largest distance of a segment from its curve or surface: a length in mm such as 0.05, or a share of the size such as 2%; empty = any</source>
        <translation>Écart admis entre un segment et sa courbe ou surface : une longueur en mm comme 0.05, ou une part de la taille comme 2% ; vide = quelconque</translation>
    </message>
    <message>
        <source>Number of segments on edges, such as Edge4=20; opposite edges of grids get the same number; empty = by size</source>
        <translation>Nombre de segments des arêtes, par exemple Edge4=20 ; celles qui leur font face en reçoivent autant ; vide = selon la taille</translation>
    </message>
    <message>
        <source>Ratio of each segment&apos;s length to that of the one before, such as Edge4=1.2; empty = none</source>
        <translation>Rapport de la longueur de chaque segment d’une arête au précédent, par exemple Edge4=1.2 ; vide = aucun</translation>
    </message>
    <message>
        <source>Unit of length of the grid in millimeters, for its coordinates and its sizes</source>
        <translation>Millimètres par unité de longueur de la grille, pour les lieux et les tailles</translation>
    </message>
    <message>
        <source>Rings</source>
        <translation>Anneaux</translation>
    </message>
    <message>
        <source>Rings of quads around each hole without corners, if there is room for them; 0 = none</source>
        <translation>Anneaux de quadrangles autour de chaque trou sans coin, là où il y a de la place ; 0 = aucun</translation>
    </message>
    <message>
        <source>Sizes in space: box:x,y,z,x,y,z=SIZE, sphere:x,y,z,r=SIZE, cylinder:x,y,z,x,y,z,r=SIZE, halfspace:x,y,z,nx,ny,nz=SIZE (the side that the direction points to), in mm; SIZE,LENGTH: around the region the size grows to the global one over that length; empty = none</source>
        <translation>Tailles dans l’espace : box:x,y,z,x,y,z=TAILLE, sphere:x,y,z,r=TAILLE, cylinder:x,y,z,x,y,z,r=TAILLE, halfspace:x,y,z,nx,ny,nz=TAILLE (du côté de la direction), en mm ; TAILLE,LONGUEUR : autour, la taille croît jusqu’à la taille globale sur cette longueur ; vide = aucune</translation>
    </message>
    <message>
        <source>Surface: sizes grow along faces and across their edges, but not across gaps or through walls; space: through air too</source>
        <translation>surface : les tailles croissent le long des faces et par leurs arêtes, ni en travers des vides ni à travers les parois ; space : à travers l’air aussi</translation>
    </message>
    <message>
        <source>The same ratio from both ends of an edge to its middle; empty = none</source>
        <translation>De même des deux bouts d’une arête vers son milieu ; vide = aucun</translation>
    </message>
    <message>
        <source>Factor for the sizes in the grid</source>
        <translation>Les tailles de la grille multipliées par cette valeur</translation>
    </message>
    <message>
        <source>any</source>
        <translation>quelconque</translation>
    </message>
    <message>
        <source>by size</source>
        <translation>selon la taille</translation>
    </message>
    <message>
        <source>space</source>
        <translation>espace</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>surface</translation>
    </message>
    <message>
        <source>Faces and edges that keep nodes of their own, whatever their size and shape, such as Edge7,Face3; empty = none</source>
        <translation>Faces et arêtes qui gardent leurs propres nœuds, quelles que soient leur taille et leur forme, par exemple Edge7,Face3 ; vide = aucune</translation>
    </message>
    <message>
        <source>Also mesh features below the reach instead of suppressing them, and let no quad cross a smooth edge</source>
        <translation>Mailler aussi les détails plus petits que la portée au lieu de les omettre, et ne laisser aucun quadrangle traverser une arête lisse</translation>
    </message>
    <message>
        <source>Suppress edges shorter and faces narrower than this length, where that does no harm; 0 = half the minimum size</source>
        <translation>Omettre les arêtes plus courtes et les faces plus étroites que cette longueur, là où cela ne nuit pas ; 0 = la moitié de la taille minimale</translation>
    </message>
    <message>
        <source>half the minimum size</source>
        <translation>la moitié de la taille minimale</translation>
    </message>
    <message>
        <source>A place on a face, edge or vertex that gets a node and a group of that node, x,y,z or Name=x,y,z in mm; without a name the groups are Node1, Node2, ...; empty = none</source>
        <translation>Un endroit sur une face, une arête ou un sommet qui reçoit un nœud et un groupe de ce nœud, x,y,z ou Nom=x,y,z en mm ; sans nom, les groupes s'appellent Node1, Node2, ... ; vide = aucun</translation>
    </message>
    <message>
        <source>Fill holes</source>
        <translation>Boucher les trous</translation>
    </message>
    <message>
        <source>Leave out holes, pockets and bosses that are no wider than this length; 0 = all are meshed</source>
        <translation>Laisser de côté les trous, poches et bossages qui ne sont pas plus larges que cette longueur ; 0 = tous sont maillés</translation>
    </message>
    <message>
        <source>Largest length over width of quads in rows over bends, fillets and narrow faces; 1 = squares</source>
        <translation>Plus grand rapport longueur sur largeur des quadrangles en rangées sur les plis, les congés et les faces étroites ; 1 = carrés</translation>
    </message>
</context>
<context>
    <name>QuadrilleStatus</name>
    <message>
        <source>up to date</source>
        <translation>à jour</translation>
    </message>
    <message>
        <source>not meshed yet</source>
        <translation>pas encore maillé</translation>
    </message>
    <message>
        <source>the part has changed: mesh again</source>
        <translation>la pièce a changé : maillez à nouveau</translation>
    </message>
    <message>
        <source>the settings have changed: mesh again</source>
        <translation>les réglages ont changé : maillez à nouveau</translation>
    </message>
    <message>
        <source>the part is gone</source>
        <translation>la pièce n'existe plus</translation>
    </message>
    <message>
        <source>the part has changed: choose faces, edges, vertices again</source>
        <translation>la pièce a changé : choisissez à nouveau faces, arêtes, sommets</translation>
    </message>
    <message>
        <source>the settings make no sense</source>
        <translation>les réglages n'ont pas de sens</translation>
    </message>
    <message>
        <source>made by other means: mesh again</source>
        <translation>fait par d'autres moyens : maillez à nouveau</translation>
    </message>
    <message>
        <source>the part and the settings have changed: mesh again</source>
        <translation>la pièce et les réglages ont changé : maillez à nouveau</translation>
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
        <translation>Adapter le maillage aux résultats</translation>
    </message>
    <message>
        <source>Estimate the error of the stresses in the result of the analysis, and mesh again with sizes that spread it evenly; then solve again</source>
        <translation>Estimer l'erreur sur les contraintes dans le résultat de l'analyse, et remailler avec des tailles qui la répartissent également ; puis résoudre à nouveau</translation>
    </message>
</context>
<context>
    <name>Quadrille_Export</name>
    <message>
        <source>Export quad mesh</source>
        <translation>Exporter le maillage de quadrangles</translation>
    </message>
    <message>
        <source>Write the mesh to a file for CalculiX, Gmsh, Salome, ParaView or Nastran, with its sets and groups</source>
        <translation>Écrire le maillage dans un fichier pour CalculiX, Gmsh, Salome, ParaView ou Nastran, avec ensembles et groupes</translation>
    </message>
</context>
<context>
    <name>Quadrille_Flip</name>
    <message>
        <source>Flip shell normals</source>
        <translation>Retourner les normales de coque</translation>
    </message>
    <message>
        <source>Flip the shell normals of the selected faces (of all faces if none is selected) and mesh again</source>
        <translation>Retourner les normales des faces sélectionnées (de toutes si aucune ne l'est) ; maille à nouveau</translation>
    </message>
</context>
<context>
    <name>Quadrille_Mesh</name>
    <message>
        <source>Quad mesh from shape</source>
        <translation>Maillage de quadrangles</translation>
    </message>
    <message>
        <source>Mesh the selected part with quads; several parts are joined where they touch</source>
        <translation>Mailler la pièce sélectionnée en quadrangles ; plusieurs pièces sont jointes où elles se touchent</translation>
    </message>
</context>
<context>
    <name>Quadrille_Middle</name>
    <message>
        <source>Middle surface</source>
        <translation>Surface moyenne</translation>
    </message>
    <message>
        <source>Turn a thin part into the surface in its middle, with its thickness in the active analysis; several parts are joined where they touch</source>
        <translation>Remplacer une pièce mince par la surface en son milieu, avec son épaisseur dans l’analyse active ; plusieurs pièces sont jointes là où elles se touchent</translation>
    </message>
</context>
<context>
    <name>Quadrille_Normals</name>
    <message>
        <source>Show shell normals</source>
        <translation>Montrer les normales de coque</translation>
    </message>
    <message>
        <source>Show the normals of the shell elements as arrows, or hide them again</source>
        <translation>Montrer les normales des éléments de coque par des flèches, ou les cacher</translation>
    </message>
</context>
<context>
    <name>Quadrille_Quality</name>
    <message>
        <source>Mesh quality</source>
        <translation>Qualité du maillage</translation>
    </message>
    <message>
        <source>Show the quality of a quad mesh: numbers, histogram, colors, worst elements</source>
        <translation>Montrer la qualité d'un maillage : nombres, histogramme, couleurs, pires éléments</translation>
    </message>
</context>
<context>
    <name>Quadrille_Refine</name>
    <message>
        <source>Refine faces, edges, vertices</source>
        <translation>Raffiner faces, arêtes, sommets</translation>
    </message>
    <message>
        <source>Give the selected faces, edges or vertices a size of their own (a FEM mesh region)</source>
        <translation>Donner une taille propre aux faces, arêtes ou sommets sélectionnés (région de maillage FEM)</translation>
    </message>
</context>
<context>
    <name>Quadrille_Solve</name>
    <message>
        <source>Solve</source>
        <translation>Résoudre</translation>
    </message>
    <message>
        <source>Solve the analysis of a quad mesh with CalculiX, and show the stresses</source>
        <translation>Résoudre l’analyse d’un maillage de quadrangles avec CalculiX et afficher les contraintes</translation>
    </message>
</context>
<context>
    <name>Quadrille_Surface</name>
    <message>
        <source>Quad mesh from mesh</source>
        <translation>Quadrangles à partir d’un maillage</translation>
    </message>
    <message>
        <source>Remesh the selected mesh object, such as a scan or an STL file, with quads</source>
        <translation>Remailler en quadrangles l’objet maillage sélectionné, par exemple un scan ou un fichier STL</translation>
    </message>
</context>
</TS>
