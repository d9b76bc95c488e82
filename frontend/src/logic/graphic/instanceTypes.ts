/** The types of the instances that a text declares: what is written in their boxes, and which of their values are shown. */

/** The type of an instance, as it is known at a place; undefined where the text does not say. */
export type TypeOf = (name: string) => string | undefined;

export const UNKNOWN: TypeOf = () => undefined;

interface Declared {
  name: string;
  type: string;
  at: number;
}

const DECLARED =
  /([\p{L}_][\p{L}\p{N}_]*(?:\s*,\s*[\p{L}_][\p{L}\p{N}_]*)*)\s*:\s*([\p{L}_][\p{L}\p{N}_.]*)\s*(?=[;:(])/gu;
const PLAIN =
  /^(?:BOOL|L?REAL|U?[SDL]?INT|BYTE|[DL]?WORD|L?TIME|L?DATE|L?TOD|L?DT|L?TIME_OF_DAY|L?DATE_AND_TIME|W?STRING|W?CHAR)$/i;

export class InstanceTypes {
  private readonly declared: readonly Declared[];
  /** The same as long as they are. */
  readonly key: string;

  constructor(text: string) {
    this.declared = [...text.matchAll(DECLARED)]
      .filter(([, , type = ""]) => !PLAIN.test(type))
      .flatMap(({ index, 1: names = "", 2: type = "" }) =>
        names.split(",").map((name) => ({ name: name.trim().toUpperCase(), type, at: index })),
      );
    this.key = this.declared.map(({ name, type }) => `${name}:${type}`).join(" ");
  }

  /** As they are known at a place of the text: of two POUs that declare the same name the one above. */
  at(place: number): TypeOf {
    return (name) => this.declared.findLast((each) => each.name === name.toUpperCase() && each.at < place)?.type;
  }
}

/** The output of a timer or counter that tells how far it is; undefined of other blocks. */
export function progressOf(type: string | undefined): string | undefined {
  if (/^(?:TON|TOF|TP)(?:_L?TIME)?$/i.test(type ?? "")) return "ET";
  return /^CT(?:U|D|UD)(?:_U?[DL]?INT)?$/i.test(type ?? "") ? "CV" : undefined;
}
