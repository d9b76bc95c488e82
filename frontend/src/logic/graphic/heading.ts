/** The lines above a drawing: its title and its comment, whole. How many there are follows from the text and the width alone. */

/** Of texts in the font of the page, as parts of its size: a little more than they are, so that a line never is too long for its room. */
const NARROW = 0.36;
const LOWER = 0.6;
const UPPER = 0.7;
const BROAD = 0.95;
const BOLD = 1.08;
const SIZE = 12;

/** East Asian characters: as wide as the font is high, and a line may end after each. */
const EAST = /[\u1100-\u115f\u2e80-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe4f\uff00-\uff60\uffe0-\uffe6]/u;

function partOf(character: string): number {
  if (EAST.test(character)) return 1;
  if (/[il.,:;'|!()[\]jftI /-]/.test(character)) return NARROW;
  if (/[mwMWQ@%—…]/.test(character)) return BROAD;
  return /\p{Lu}/u.test(character) ? UPPER : LOWER;
}

const widthOf = (text: string, bold: boolean) =>
  [...text].reduce((sum, character) => sum + partOf(character), 0) * SIZE * (bold ? BOLD : 1);

/** The lines of a text that is at most this wide; a word that is wider is divided. */
function linesOf(text: string, width: number, bold: boolean): string[] {
  const lines: string[] = [];
  let line = "";
  for (const piece of text.split(/(?<= )/).flatMap(piecesOf)) {
    if (line !== "" && widthOf((line + piece).trimEnd(), bold) > width) {
      lines.push(line.trimEnd());
      line = "";
    }
    for (const character of piece) {
      if (line !== "" && widthOf(line + character, bold) > width && character !== " ") {
        lines.push(line);
        line = "";
      }
      line += character;
    }
  }
  if (line.trim() !== "") lines.push(line.trimEnd());
  return lines;
}

/** Where a line may end inside of a word without blanks. */
const piecesOf = (word: string) => (EAST.test(word) ? [...word] : [word]);

export interface Heading {
  title: readonly string[];
  /** The comment is in the line of the title. */
  beside: boolean;
  comment: readonly string[];
  /** In pixels. */
  height: number;
}

const FIRST = 28;
const NEXT = 18;
const GAP = 12;

/** The heading in this width; at the right there is room for what is said about the part. */
export function headingOf(title: string, comment: readonly string[], width: number, before = ""): Heading {
  const left = before === "" ? 0 : widthOf(before, false) * 1.2 + GAP;
  const room = Math.max(120, width - Math.min(200, width / 3) - left);
  const lines = linesOf(title, room, true);
  const words = comment.join(" ").trim();
  const beside = lines.length < 2 && widthOf(lines[0] ?? "", true) + GAP + widthOf(words, false) <= room;
  const below = beside ? [words] : comment.flatMap((line) => linesOf(line, width, false));
  const more = Math.max(0, lines.length - 1) + (beside ? 0 : below.length);
  return { title: lines, beside, comment: words === "" ? [] : below, height: FIRST + more * NEXT };
}
