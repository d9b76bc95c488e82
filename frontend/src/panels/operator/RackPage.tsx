/** All inputs and outputs at once, made from the model and the program: to operate what has no panel yet. */
import { useEffect } from "react";
import { splitPath } from "../../logic/format/paths";
import { byUnit } from "../../logic/operator/rack";
import { forgetRefusal, operate, useRefused } from "../../store/operator/operate";
import { loadRack, useRack } from "../../store/operator/rack";
import { useBench } from "../../store/plc/bench";
import { useForbidden, usePlc } from "../../store/plc/plc";
import { useForcedAt } from "../../store/watch/forces";
import { t } from "../../text";
import { Empty } from "../../ui/Empty";
import { Icon } from "../../ui/Icon";
import type { Channel, ChannelUnit, PlcSymbol } from "../../wire/types";
import { NumberField } from "./OperatedElement";
import "./operator.css";
import { useReading } from "./useReading";

export function RackPage() {
  const { channels, trouble } = useRack();
  const instance = useBench((bench) => bench.instance?.id);
  const version = usePlc((plc) => plc.state?.program_version);
  const online = usePlc((plc) => plc.link.state === "open");
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different program may use other words
  useEffect(() => {
    if (online) void loadRack();
  }, [instance, version, online]);

  return (
    <section className="pane flexcol operator" aria-label={t("rack.title")} data-pane="rack" data-live>
      {trouble !== null && (
        <p className="trouble st warning" role="status">
          <Icon name="warning" small />
          <span>{t("rack.trouble", { message: trouble })}</span>
        </p>
      )}
      {channels?.length === 0 && <Empty title={t("rack.none")} about={t("rack.none.about")} ways={[]} />}
      <div className="opracks">
        {byUnit(channels ?? []).map(({ unit, channels: own }) => (
          <Unit
            key={own[0]?.address}
            unit={unit}
            channels={own}
            alone={channels?.every((each) => !each.unit) ?? true}
          />
        ))}
      </div>
    </section>
  );
}

/** The words of one unit, below its place and name; without hardware.json, or where it names no words, all words together. */
function Unit({ unit, channels, alone }: { unit: ChannelUnit | null; channels: readonly Channel[]; alone: boolean }) {
  const cards = channels.map((channel) => <ChannelCard key={channel.address} channel={channel} />);
  if (alone) return <div className="oprack">{cards}</div>;
  const title = unit ? nameOfUnit(unit) : t("rack.unit.none");
  return (
    <section aria-label={title}>
      <h2 className="opplace">{title}</h2>
      <div className="oprack">{cards}</div>
    </section>
  );
}

function nameOfUnit({ rack, slot, number, kind, name }: ChannelUnit): string {
  const place = rack === null || slot === null ? null : t("rack.unit.place", { rack, slot });
  const unit = name === "" ? `${kind}${number === null ? "" : ` ${number}`}` : name;
  return place === null ? unit : `${place}: ${unit}`;
}

function ChannelCard({ channel: { address, side, terminals } }: { channel: Channel }) {
  const title = t(`rack.${side}`, { address });
  return (
    <section className={`opunit ${side}`} aria-label={title}>
      <h3>{title}</h3>
      {terminals.map((terminal) => (
        <Terminal key={terminal.path} terminal={terminal} side={side} />
      ))}
    </section>
  );
}

function Terminal({ terminal, side }: { terminal: PlcSymbol; side: Channel["side"] }) {
  const { path, kind } = terminal;
  const control = `rack:${path}`;
  const reading = useReading(path);
  const forced = useForcedAt(path);
  const refused = useRefused(({ of }) => of.get(control));
  const forbidden = useForbidden("write");
  const named = terminal.address !== null && terminal.address !== path;
  const locked = terminal.writable ? forbidden : t("watch.readonly");
  const body = (
    <>
      <span className="opaddress mono">{terminal.address ?? path}</span>
      {kind === "bool" && <span className={`oplight${reading.on ? " on" : ""}`} />}
      <span className={`cut${named ? "" : " faint"}`}>{named ? splitPath(path).name : ""}</span>
      {forced && (
        <span className="st forced" role="img" aria-label={t("forced")} title={t("force.to", { value: forced.value })}>
          <Icon name="forced" small />
        </span>
      )}
    </>
  );
  const label = named ? `${path}, ${terminal.address}` : path;
  return (
    <div className="opterminal" title={refused ?? label}>
      {kind === "bool" && side === "input" ? (
        <button
          type="button"
          role="switch"
          aria-label={label}
          aria-checked={reading.on === true}
          disabled={locked !== null || reading.on === null}
          title={locked ?? t("rack.toggle", { path })}
          onClick={() => void operate(control, path, reading.on ? "FALSE" : "TRUE")}
        >
          {body}
        </button>
      ) : (
        <span
          className="opread"
          role={kind === "bool" ? "img" : undefined}
          aria-label={kind === "bool" ? `${label}: ${reading.text}` : undefined}
        >
          {body}
        </span>
      )}
      {kind !== "bool" && (
        <NumberField
          element={{ id: control, path }}
          label={label}
          reading={reading}
          locked={side === "output" ? t("rack.held") : locked}
        />
      )}
      {refused !== undefined && (
        <button type="button" className="oprefused" title={refused} onClick={() => forgetRefusal(control)}>
          <Icon name="error" small />
          <span role="alert">{refused}</span>
        </button>
      )}
    </div>
  );
}
