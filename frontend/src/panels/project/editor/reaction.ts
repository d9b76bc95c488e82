/** Marks the lines that took part in the reaction to the selected error: its readers, and the lines that ran only because of it. */
import { readersOf, stretchesOf } from "../../../logic/errors/reaction";
import { catalogueNow } from "../../../store/errors/catalogue";
import { useReaction } from "../../../store/errors/reaction";
import { t } from "../../../text";
import type { Reaction } from "../../../wire/types";
import type { editor } from "./monaco";

/** Marks them in this editor while the error is selected. Returns a function that stops it. */
export function markReaction(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  const mark = () => {
    const { id, reaction } = useReaction.getState();
    const name = id === null ? "" : (catalogueNow().byId.get(id)?.name ?? id);
    marks.set(reaction ? decorations(reaction, name, path) : []);
  };
  mark();
  return useReaction.subscribe(mark);
}

function decorations(reaction: Reaction, name: string, path: string): editor.IModelDeltaDecoration[] {
  const readers = readersOf(reaction).filter((place) => place.file === path);
  const handlers = stretchesOf(reaction).filter((stretch) => stretch.file === path);
  return [
    ...handlers.map(({ from, to }) => handlerLines(from, to, t("reaction.handler", { error: name }))),
    ...readers.map(({ line, says }) => readerLine(line, says, `${name}: ${says}`)),
  ];
}

function handlerLines(from: number, to: number, text: string): editor.IModelDeltaDecoration {
  return {
    range: { startLineNumber: from, startColumn: 1, endLineNumber: to, endColumn: 1 },
    options: {
      isWholeLine: true,
      linesDecorationsClassName: "handlerbar",
      linesDecorationsTooltip: text,
      hoverMessage: { value: text },
      overviewRuler: null,
    },
  };
}

/** An eye beside the line number, and the text that was read at the end of the line: a mark alone is not clear enough. */
function readerLine(line: number, says: string, text: string): editor.IModelDeltaDecoration {
  const end = Number.MAX_SAFE_INTEGER;
  return {
    range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: end },
    options: {
      linesDecorationsClassName: "readermark",
      linesDecorationsTooltip: text,
      hoverMessage: { value: text },
      after: { content: `    ${says}`, inlineClassName: "readersays" },
    },
  };
}
