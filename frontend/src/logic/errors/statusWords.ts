/** The status words as they are shown: one each, except an error code with several words, which is shown as one, its low word first. */
export function statusWords(words: readonly string[], code: readonly string[]): (readonly [string, ...string[]])[] {
  const [low, ...more] = code;
  return words.filter((word) => !more.includes(word)).map((word) => (word === low ? [word, ...more] : [word]));
}
