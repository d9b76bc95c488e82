/** Renames a name in all files of the project. Files that are not open are opened, as the change is theirs and not saved yet. */

import type { Range, WorkspaceEdit } from "vscode-languageserver-types";
import { messageOf } from "../../../logic/format/messageOf";
import { openFile } from "../../../store/page/navigate";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { demandAt, pathOf } from "../../../store/project/language";
import { applyEdits } from "./graphic/write";
import { modelOf } from "./models";
import { editor, languages } from "./monaco";
import { at, isPast, pathOfModel, rangeOf, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

/** The text in which a name was last asked for. */
let renaming: editor.ITextModel | null = null;

languages.registerRenameProvider(LANGUAGE, {
  resolveRenameLocation: async (model, position, token) => {
    const nothing = { range: rangeOf(EMPTY), text: "" };
    if (isPast(model)) return nothing;
    renaming = model;
    try {
      const path = pathOfModel(model);
      const found = await demandAt<{ range: Range; placeholder: string }>(
        "textDocument/prepareRename",
        path,
        at(position),
        {},
        signalOf(token),
      );
      return found ? { range: rangeOf(found.range), text: found.placeholder } : nothing;
    } catch (error) {
      return { ...nothing, rejectReason: messageOf(error) };
    }
  },
  provideRenameEdits: async (model, position, newName, token) => {
    try {
      const changes = await renamed(pathOfModel(model), at(position), newName, signalOf(token));
      return {
        edits: changes.flatMap(({ path, edits }) => {
          const { uri } = modelOf(path, useDocuments.getState().open[path]?.text ?? "");
          return edits.map(({ range, newText }) => ({
            resource: uri,
            versionId: undefined,
            textEdit: { range: rangeOf(range), text: newText },
          }));
        }),
      };
    } catch (error) {
      return { edits: [], rejectReason: messageOf(error) };
    }
  },
});

/** The edits of a different name, by file. Files that they are in are open then. */
async function renamed(here: string, place: { line: number; column: number }, newName: string, signal?: AbortSignal) {
  const wanted = () => demandAt<WorkspaceEdit>("textDocument/rename", here, place, { newName }, signal);
  const changes = changesOf(await wanted());
  const closed = changes.filter(({ path }) => !useDocuments.getState().open[path]);
  if (closed.length === 0) return changes;
  // This browser may have a text of a closed file that is not saved: the edits have to be those of that text.
  for (const { path } of closed) {
    await openDocument(path);
    openFile(path);
  }
  openFile(here);
  return changesOf(await wanted());
}

/** Gives what is at a place a different name, in all files. Rejects with why that is not possible. */
export async function renameAt(path: string, place: { line: number; column: number }, newName: string): Promise<void> {
  for (const { path: file, edits } of await renamed(path, place, newName)) applyEdits(file, edits);
}

const changesOf = (found: WorkspaceEdit | null) =>
  Object.entries(found?.changes ?? {}).map(([uri, edits]) => ({ path: pathOf(uri), edits }));

/** The field for the name lives in the element of all popups, in which Monaco hears no keys. */
const KEYS: Record<string, string> = { Enter: "acceptRenameInput", Escape: "cancelRenameInput" };

document.addEventListener("keydown", (event) => {
  const command = KEYS[event.key];
  const { target } = event;
  if (!command || !(target instanceof HTMLElement) || !target.classList.contains("rename-input")) return;
  event.preventDefault();
  for (const code of editor.getEditors()) if (code.getModel() === renaming) code.trigger("rename", command, {});
});

const EMPTY: Range = { start: { line: 0, character: 0 }, end: { line: 0, character: 0 } };
