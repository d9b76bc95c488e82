import { useShallow } from "zustand/react/shallow";
import { inNames } from "../../../logic/errors/catalogue";
import { troubles } from "../../../logic/errors/details";
import { idOf } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import {
  asksFirst,
  chosenOf,
  entriesOf,
  instancesOf,
  untickAll,
  useSimulator,
  wantedNow,
} from "../../../store/errors/simulator";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { GenerateOne } from "../../../wire/types";
import { Preview } from "./Preview";

/** So many are named; the others are counted. */
const NAMED = 4;

const useTicks = () =>
  useSimulator(
    useShallow(({ checked, selected, details, filter, status, severity, reaction }) => ({
      ...{ checked, selected, details },
      ...{ filter, status, severity, reaction },
    })),
  );

/** Whether the buttons raise something else than the error whose details are shown. */
export function useOthersTicked(shown: GenerateOne): boolean {
  const state = useTicks();
  const { errors } = useCatalogue();
  const wanted = wantedNow(state, errors);
  return wanted.length > 0 && JSON.stringify(wanted) !== JSON.stringify([shown]);
}

/** Says what When, How and the buttons are of while rows are ticked and the panel shows a different one. */
export function Ticked({ name }: { name: string }) {
  const state = useTicks();
  const { errors } = useCatalogue();
  const instances = usePlc((plc) => plc.instances);
  const single = instancesOf(state);
  const words = [
    ...chosenOf(state, errors).map((error) => error.name),
    ...single.map((key) => inNames(errors, `${idOf(key)} (${key.slice(idOf(key).length + 1)})`, instances)),
  ];
  const named = words.slice(0, NAMED).join(", ");
  const more = words.length - NAMED;
  return (
    <p className="tickednote">
      <Icon name="info" small />
      <span>
        {more > 0 ? t("errors.ticked.more", { names: named, count: more }) : t("errors.ticked", { names: named })}{" "}
        <button type="button" className="link" onClick={untickAll}>
          {t("errors.ticked.only", { name })}
        </button>
      </span>
    </p>
  );
}

/** What raising the ticked errors would write. */
export function TickedPreview({ now }: { now: boolean }) {
  const state = useTicks();
  const { errors } = useCatalogue();
  const history = usePlc((plc) => plc.errors);
  const valid = chosenOf(state, errors).every(
    (error) => troubles(error, entriesOf(state, error, history.get(error.id))).size === 0,
  );
  return <Preview wanted={wantedNow(state, errors)} valid={valid} now={now && !asksFirst(state, errors)} named />;
}
