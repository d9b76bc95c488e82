import { memo } from "react";
import { bytes, grouped, interval, percent } from "../../../logic/format/numbers";
import { showState } from "../../../logic/plc/plcstate";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { Instance } from "../../../wire/types";
import { limitsIn } from "./limitsIn";

interface Props {
  instance: Instance;
  index: number;
  top: number;
  selected: boolean;
  onSelect: (id: number) => void;
  onOpen: (instance: Instance) => void;
  onMenu: (instance: Instance, at: { x: number; y: number }) => void;
}

/** A share of late scans above this is shown. */
const LATE = 1;

/** One instance. A row is drawn again only when its data changed. */
export const InstanceLine = memo(
  function InstanceLine({ instance, index, top, selected, onSelect, onOpen, onMenu }: Props) {
    const { state, load } = instance;
    const shown = showState(state, true);
    const off = state.state === "off";
    const cost = (text: string) => (off ? "–" : text);
    return (
      <div
        id={`instance-${instance.id}`}
        className={`gr${selected ? " on" : ""}`}
        role="row"
        data-instance={instance.name}
        aria-rowindex={index + 2}
        aria-selected={selected}
        style={{ transform: `translateY(${top}px)` }}
        onClick={() => onSelect(instance.id)}
        onDoubleClick={() => onOpen(instance)}
        onContextMenu={(event) => {
          event.preventDefault();
          onSelect(instance.id);
          onMenu(instance, { x: event.clientX, y: event.clientY });
        }}
      >
        <span role="gridcell" className="cut" title={facts(instance)}>
          <b>{instance.name}</b>
        </span>
        <span role="gridcell" className="muted cut" title={instance.project.name}>
          {instance.project.name}
        </span>
        <span role="gridcell" className="muted cut c-model" title={instance.model}>
          {instance.model}
        </span>
        <span role="gridcell" className={`st ${shown.tone}`} title={state.message || shown.detail}>
          <Icon name={shown.icon} small />
          <span className="cut">{shown.word}</span>
          {!off && <span className="muted modeword">{state.mode}</span>}
        </span>
        <span role="gridcell" className="num">
          {grouped(state.scan)}
        </span>
        <span role="gridcell" className="num muted">
          {interval(state.interval_ns)}
        </span>
        <span role="gridcell" className="num">
          {cost(percent(load.cpu_percent))}
        </span>
        <span role="gridcell" className="num">
          {cost(bytes(load.memory_bytes))}
        </span>
        <span role="gridcell" className={`num${!off && state.late_percent >= LATE ? " late" : ""}`}>
          {cost(percent(state.late_percent))}
        </span>
        <span role="gridcell" className="num">
          {bytes(load.run_bytes)}
        </span>
        <span role="gridcell" className="muted cut c-limits" title={limitsIn(instance.limits)}>
          {limitsIn(instance.limits)}
        </span>
      </div>
    );
  },
  (a, b) =>
    a.index === b.index &&
    a.top === b.top &&
    a.selected === b.selected &&
    JSON.stringify(a.instance) === JSON.stringify(b.instance),
);

/** In a narrow window the tooltip of the name has the data of hidden columns. */
function facts({ name, model, limits }: Instance): string {
  return [name, model, `${t("instances.column.limits")}: ${limitsIn(limits)}`].join("\n");
}
