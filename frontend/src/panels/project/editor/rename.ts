/** Renames a name in all files of the project. Files that are not open are opened, as the change is theirs and not saved yet. */

import type { Range, WorkspaceEdit } from "vscode-languageserver-types";
import { messageOf } from "../../../logic/format/messageOf";
import { openFile } from "../../../store/page/navigate";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { demandAt, pathOf } from "../../../store/project/language";
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
    const here = pathOfModel(model);
    const wanted = () =>
      demandAt<WorkspaceEdit>("textDocument/rename", here, at(position), { newName }, signalOf(token));
    try {
      let changes = changesOf(await wanted());
      const closed = changes.filter(({ path }) => !useDocuments.getState().open[path]);
      if (closed.length > 0) {
        // This browser may have a text of a closed file that is not saved: the edits have to be those of that text.
        for (const { path } of closed) {
          await openDocument(path);
          openFile(path);
        }
        openFile(here);
        changes = changesOf(await wanted());
      }
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
