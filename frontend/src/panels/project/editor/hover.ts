/** The meaning and the value of a name: in the frame while the program is halted, else in the instance that the text is seen as. */

import { worthOf } from "../../../store/debug/console";
import { loadNames, seenAsNow } from "../../../store/debug/seenAs";
import { frameNow } from "../../../store/debug/stack";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import type { Pou } from "../../../wire/types";
import { languages } from "./monaco";
import { hasValues, nameAt, pouOf } from "./names";
import { LANGUAGE } from "./st";

languages.registerHoverProvider(LANGUAGE, {
  provideHover: async (model, position) => {
    const name = nameAt(model, position);
    if (!name) return null;
    const said = (await variable(name.text, pouOf(model, position.lineNumber))) ?? declaration(name.text);
    if (!said) return null;
    const line = position.lineNumber;
    const range = { startLineNumber: line, endLineNumber: line, startColumn: name.from, endColumn: name.to };
    return { range, contents: said.map((value) => ({ value })) };
  },
});

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
  return [code(`${name} : ${found.type ?? ""} := ${found.result}`), ...where];
}

/** A POU, or a type of the project. */
function declaration(name: string): string[] | null {
  const found = useDocuments.getState().pous.find((pou) => pou.name.toUpperCase() === name.toUpperCase());
  if (!found) return null;
  return [code(found.name), `${t(`kind.${found.kind}`)} · ${found.file}:${found.line}`];
}
