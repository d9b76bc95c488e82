import { useRef } from "react";
import { pathBefore, withPath } from "../../../logic/plc/expression";
import { useRun } from "../../../store/debug/run";
import { complete } from "../../../store/plc/completion";
import { ComboBox } from "../../../ui/ComboBox";
import { type Offer, useOffers } from "../../../ui/useOffers";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  bad?: boolean;
}

const MOST = 6;

/** A field for a condition. It completes paths of the running program at the caret; while empty, it offers earlier conditions. */
export function ConditionBox({ label, value, onChange, bad = false }: Props) {
  const input = useRef<HTMLInputElement>(null);
  const conditions = useRun((run) => run.conditions);
  const offering = useOffers<Offer>(complete, MOST);

  function take(text: string): void {
    const caret = input.current?.selectionStart ?? value.length;
    const next = withPath(value, caret, text);
    onChange(next.text);
    offering.close();
    requestAnimationFrame(() => input.current?.setSelectionRange(next.caret, next.caret));
  }

  return (
    <span className="condition">
      <ComboBox
        input={input}
        label={label}
        value={value}
        bad={bad}
        className={`inp sm mono${bad ? " bad" : ""}`}
        placeholder="Main.count > 3"
        offering={offering}
        onType={(text, caret) => {
          onChange(text);
          offering.ask(pathBefore(text, caret));
        }}
        onTake={({ path }) => take(path)}
        onFocus={() => {
          if (value === "") offering.show(conditions.map((text) => ({ path: text, type: "" })));
        }}
        list="conditionoffers"
        listed={label}
      />
    </span>
  );
}
