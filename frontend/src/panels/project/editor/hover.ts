/** The value of a name, in the frame while the program is halted, else in the instance whose values the text shows; and its declaration. */

import type { Hover } from "vscode-languageserver-types";
import { worthOf } from "../../../store/debug/console";
import { loadNames, seenAsNow } from "../../../store/debug/seenAs";
import { frameNow } from "../../../store/debug/stack";
import { askAt } from "../../../store/project/language";
import { t } from "../../../text";
import type { Pou } from "../../../wire/types";
import { liveHover } from "./liveHover";
import { languages } from "./monaco";
import { hasValues, nameAt, pouOf } from "./names";
import { at, isPast, pathOfModel, signalOf, textOf } from "./serverShapes";
import { LANGUAGE } from "./st";

languages.registerHoverProvider(LANGUAGE, {
  provideHover: async (model, position, token) => {
    const name = nameAt(model, position);
    if (!name) return null;
    const path = pathOfModel(model);
    const asked = isPast(model) ? null : askAt<Hover>("textDocument/hover", path, at(position), {}, signalOf(token));
    const told = textOf((await asked)?.contents);
    // A type or POU may have the name of a variable, and has no value.
    const value = HEAD.test(told) ? null : await variable(name.text, pouOf(model, position.lineNumber));
    const said = [...(value ?? []), told].filter(Boolean);
    if (said.length === 0) return null;
    const line = position.lineNumber;
    const range = { startLineNumber: line, endLineNumber: line, startColumn: name.from, endColumn: name.to };
    return { range, contents: said.map((text) => ({ value: text })) };
  },
});

/** The declaration of something that has no value. */
const HEAD = /^```st\n(?:PROGRAM|FUNCTION|FUNCTION_BLOCK|CLASS|INTERFACE|METHOD|TYPE)\b/;

const code = (text: string) => `\`\`\`${LANGUAGE}\n${text}\n\`\`\``;

async function variable(name: string, around: Pou | undefined): Promise<string[] | null> {
  if (around === undefined || !hasValues(around)) return null;
  const pou = around.name;
  await loadNames(pou);
  const inFrame = frameNow()?.scanbench?.pou.toUpperCase() === pou.toUpperCase();
  const instance = seenAsNow(pou);
  const whole = instance === undefined ? null : `${instance}.${name}`;
  const own = inFrame ? await worthOf(name, true) : whole && (await worthOf(whole, false));
  const found = own || (await worthOf(name, false));
  if (!found) return null;
  const where = inFrame || !own ? [] : [t("debug.seenas.hover", { instance })];
  const head = `${name} : ${found.type ?? ""}`;
  // While the program is halted, or in the past, a value stays what it is.
  if (!inFrame) liveHover(head, own && whole ? whole : name);
  return [code(`${head} := ${found.result}`), ...where];
}
