/// What the words of reports mean. The classes come first, in the order in which they are tried.
const meanings = {
  "equal": "the exact depth, rounded once to what the renderer stores; or background in both maps",
  "within quantization": "a neighbour of that depth in the storage",
  "within arithmetic": "the visible surface, with a depth within its bound",
  "edge": "another surface or none: the sample is so near to an edge that roundings decide which side it is on",
  "z-fight": "another surface, which roundings can put before the visible one; unknown where the renderer's triangle numbers were not read, since a wrong surface may have the right depth",
  "missed surface": "background where a ray slipped through between triangles that share an edge or a corner",
  "convention": "explained by a fault of the whole image, which is named among the findings",
  "unexplained": "nothing that a renderer of this kind does leads to this value: a bug",
  "bound": "the interval in which a renderer of this kind must store the depth of a surface, whatever its roundings are; its width is given relative to the depth",
  "must": "a triangle must be drawn at a pixel if it covers the pixel's sample whatever the roundings are",
  "may": "a triangle may be drawn at a pixel if roundings decide whether it covers the sample; such a pixel is undecided, and the figure is the share of them among the pixels that triangles touch",
  "finding": "a fault that was recognised and named: of the whole image, of triangles, or of single pixels",
  "not drawn": "the renderer gave no map: it refused the scene, failed or took too long"
};
/// A word that leads to its meaning.
const term = (word, name = word) => element("a", name, { class: "term", href: "#word-" + word.replaceAll(" ", "-"), title: meanings[word] });
function explainWords() {
  for (const word in meanings) {
    const c = classNames.indexOf(word), name = element("dt", undefined, { id: "word-" + word.replaceAll(" ", "-") });
    if (c >= 0) name.append(colourKey(c));
    name.append(word);
    byId("words").append(name, element("dd", meanings[word]));
  }
}
