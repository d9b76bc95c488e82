/** Errors that a tool reads from the device, in the words of the catalogue. */
import type { DeviceDetail, DeviceError, ErrorInfo } from "../../wire/types";

type Named = Pick<DeviceError, "id" | "name">;

/** The name in the language of the page; where no error of the catalogue is meant, what the server says. */
export function nameIn(byId: ReadonlyMap<string, ErrorInfo>, error: Named): string {
  return byId.get(error.id)?.name ?? error.name;
}

/** Tells present errors apart: several units of a kind may be there. */
export const deviceKey = ({ id, flag, code, details }: DeviceError) =>
  [id, flag, code, ...details.map(({ value }) => value)].join(" ");

/** The details with the texts of the catalogue: `Rack number 1`. */
export function detailsIn(error: ErrorInfo | undefined, details: readonly DeviceDetail[]): string {
  return details.map((detail) => detailIn(error, detail)).join(", ");
}

function detailIn(error: ErrorInfo | undefined, { name, value, text }: DeviceDetail): string {
  const known = error?.details.find((each) => each.name === name);
  if (!known) return text;
  const choices = value.split("+").map((id) => known.choices?.find((each) => each.id === id)?.description);
  return choices.every(Boolean) ? choices.join(", ") : `${known.description || name} ${value}`;
}
