import { useState } from "react";
import { bounded } from "../../../logic/verify/traceImport";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import type { TraceColumnMap } from "../../../wire/types";

const WIDTH = 380;
const MOST_MS = 10_000;

const BAD = [
  "import.trace.tolerance.bad",
  "import.trace.tolerance.bad.percent",
  "import.trace.tolerance.bad.ms",
] as const;

type Within = Pick<TraceColumnMap, "absolute" | "relative" | "late_ms">;

interface Props {
  row: TraceColumnMap;
  onChange: (within: Within) => void;
  onClose: () => void;
}

/** By what the recorded values of an output may differ from those of the reference. */
export function Tolerance({ row, onChange, onClose }: Props) {
  const [absolute, setAbsolute] = useState(shown(row.absolute));
  const [percent, setPercent] = useState(shown(row.relative * 100));
  const [late, setLate] = useState(shown(row.late_ms));
  const typed = [bounded(absolute, Number.MAX_VALUE), bounded(percent, 100), bounded(late, MOST_MS)] as const;
  const refused = (at: 0 | 1 | 2) => (typed[at] === null ? t(BAD[at]) : null);
  return (
    <FormDialog
      title={t("import.trace.tolerance.of", { column: row.column })}
      about={t("import.trace.tolerance.about")}
      width={WIDTH}
      submit={t("import.trace.tolerance.do")}
      disabled={typed.includes(null)}
      onSubmit={async () =>
        onChange({ absolute: typed[0] ?? 0, relative: (typed[1] ?? 0) / 100, late_ms: typed[2] ?? 0 })
      }
      onClose={onClose}
    >
      <Field
        label={t("import.trace.tolerance.absolute")}
        value={absolute}
        onChange={setAbsolute}
        refused={refused(0)}
      />
      <Field label={t("import.trace.tolerance.relative")} value={percent} onChange={setPercent} refused={refused(1)} />
      <Field label={t("import.trace.tolerance.late")} value={late} onChange={setLate} refused={refused(2)} />
    </FormDialog>
  );
}

const shown = (value: number) => (value === 0 ? "" : String(Number(value.toPrecision(12))));

/** The tolerance in a few characters: `±0.5, 1 %, 20 ms`. */
export function toleranceText({ absolute, relative, late_ms }: Within): string {
  const parts = [
    absolute > 0 ? `±${shown(absolute)}` : "",
    relative > 0 ? `${shown(relative * 100)} %` : "",
    late_ms > 0 ? `${shown(late_ms)} ms` : "",
  ];
  return parts.filter(Boolean).join(", ");
}
