/** Widths of texts in pixels. All texts of a drawing are in a font in which each character is as wide as the others. */

/** Of the font of 11.5 px in which operands and values are drawn. */
const CELL = 7;
/** Characters of East Asian scripts take two cells. */
const WIDE = /[\u1100-\u115f\u2e80-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe4f\uff00-\uff60\uffe0-\uffe6]/gu;

export const widthOf = (text: string) => CELL * (text.length + (text.match(WIDE)?.length ?? 0));

/** Room for a value beside a name. */
export const VALUE = 58;

const VARIABLE = /^[\p{L}_%][\p{L}\p{N}_.]*(?:\[[\p{N}\s,-]+\][\p{L}\p{N}_.]*)*$/u;
export const isVariable = (text: string) => VARIABLE.test(text) && !/^(?:TRUE|FALSE)$/i.test(text);
