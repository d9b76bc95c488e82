/** Shapes of LSP <-> shapes of Monaco. Lines and columns of LSP count from 0, those of Monaco from 1; both count UTF-16 units. */

import type { Hover, Location, MarkupContent, Range } from "vscode-languageserver-types";
import { pathOf } from "../../../store/project/language";
import { PAST, presentModel, uriOfPath } from "./models";
import type { editor, IPosition, IRange, languages } from "./monaco";

export const isPast = (model: editor.ITextModel) => model.uri.scheme === PAST;

export const pathOfModel = (model: editor.ITextModel) => model.uri.path.slice(1);

export const at = ({ lineNumber, column }: IPosition) => ({ line: lineNumber, column });

export const rangeOf = ({ start, end }: Range): IRange => ({
  startLineNumber: start.line + 1,
  startColumn: start.character + 1,
  endLineNumber: end.line + 1,
  endColumn: end.character + 1,
});

export const lspRangeOf = ({ startLineNumber, startColumn, endLineNumber, endColumn }: IRange): Range => ({
  start: { line: startLineNumber - 1, character: startColumn - 1 },
  end: { line: endLineNumber - 1, character: endColumn - 1 },
});

export const textOf = (contents: Hover["contents"] | MarkupContent | undefined) =>
  typeof contents === "object" && "value" in contents ? contents.value : "";

/** Places in files of the project. Monaco shows a text beside a place, so it needs the texts of files that are not open, too. */
export async function locationsOf(found: readonly Location[] | null): Promise<languages.Location[]> {
  const places = (found ?? []).map(({ uri, range }) => ({ path: pathOf(uri), range: rangeOf(range) }));
  await Promise.all([...new Set(places.map(({ path }) => path))].map(presentModel));
  return places.map(({ path, range }) => ({ uri: uriOfPath(path), range }));
}

/** Ends a request that Monaco does not want any more. */
export function signalOf(token: { onCancellationRequested: (then: () => void) => unknown }): AbortSignal {
  const aborting = new AbortController();
  token.onCancellationRequested(() => aborting.abort());
  return aborting.signal;
}
