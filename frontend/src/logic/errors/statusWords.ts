/** The status words as they are shown: one each, but for an error code that has more, all of its words, the low one first. */
export function statusWords(words: readonly string[], code: readonly string[]): (readonly [string, ...string[]])[] {
  const [low, ...more] = code;
  return words.filter((word) => !more.includes(word)).map((word) => (word === low ? [word, ...more] : [word]));
}
