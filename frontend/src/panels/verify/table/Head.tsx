import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { isGoing, titleOf } from "../../../logic/verify/verify";
import { useBench } from "../../../store/plc/bench";
import { useForbidden } from "../../../store/plc/plc";
import { askDisturb } from "../../../store/verify/disturb";
import { openTraceImport } from "../../../store/verify/traceImport";
import {
  askVerification,
  chooseVerification,
  deleteVerification,
  drive,
  leaveRecord,
  type ShownVerification,
  useVerify,
} from "../../../store/verify/verify";
import { openVerifyRecords } from "../../../store/verify/verifyRecords";
import { selectNewest } from "../../../store/verify/verifyRows";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { Segments } from "../../../ui/Segments";
import { Switch } from "../../../ui/Switch";

/** Gives this panel the whole dock, and back. */
export interface Whole {
  is: () => boolean;
  toggle: () => void;
}

/** What is verified, on which inputs, at which pace. */
export function Head({ shown, whole }: { shown: ShownVerification | null; whole: Whole | null }) {
  const [large, setLarge] = useState(() => whole?.is() ?? false);
  const driven = shown?.source.kind === "verification" ? shown.info : null;
  return (
    <div className="sub tall vfhead" role="toolbar" aria-label={t("panel.verify")}>
      <What shown={shown} />
      <span className="grow" />
      {driven && <Controls info={driven} />}
      {shown?.record && (
        <button type="button" className="btn sm" onClick={leaveRecord}>
          {t("verify.record.leave")}
        </button>
      )}
      {!shown && (
        <button type="button" className="btn sm" onClick={() => askVerification({ range: {}, stretch: null })}>
          <Icon name="plus" small />
          {t("verify.new")}
        </button>
      )}
      {whole && (
        <IconButton
          icon="layout"
          small
          label={t(large ? "verify.restore" : "verify.maximise")}
          onClick={() => {
            whole.toggle();
            setLarge(whole.is());
          }}
        />
      )}
    </div>
  );
}

function What({ shown }: { shown: ShownVerification | null }) {
  const name = useBench((bench) => bench.instance?.name ?? "");
  const items = (): MenuItem[] => {
    const { verifications, id, record } = useVerify.getState();
    return [
      ...verifications.map((known) => ({
        label: known.title,
        hint: `${t(`verify.state.${known.state}`)}, ${known.by}`,
        checked: !record && known.id === id,
        onSelect: () => chooseVerification(known.id),
      })),
      {
        label: t("verify.new"),
        icon: "plus",
        separated: verifications.length > 0,
        onSelect: () => askVerification({ range: {}, stretch: null }),
      },
      { label: t("verify.trace"), icon: "import", onSelect: () => openTraceImport() },
      { label: t("verify.saved"), icon: "list", onSelect: openVerifyRecords },
      { label: t("verify.disturb"), icon: "disturbance", onSelect: () => askDisturb({}) },
      ...(shown?.source.kind === "verification"
        ? [
            {
              label: t("verify.again"),
              icon: "refresh" as const,
              onSelect: () => askVerification({ range: shown.info.range, stretch: null }),
            },
            {
              label: t("verify.delete"),
              icon: "trash" as const,
              separated: true,
              onSelect: () => void deleteVerification(),
            },
          ]
        : []),
    ];
  };
  const info = shown?.info;
  return (
    <MenuButton label={t("verify.choose")} className="btn quiet vfwhat" items={items}>
      <span className="two">
        <span className="cut">
          {info && <span className="muted">{t(shown?.record ? "verify.record" : "verify.range")} </span>}
          <b>{info ? (shown?.record?.name ?? titleOf(info)) : t("verify.none")}</b>
        </span>
        <span className="cut">
          {info ? <Sides shown={shown as ShownVerification} name={name} /> : t("verify.none.about")}
        </span>
      </span>
      <Icon name="chev-d" small />
    </MenuButton>
  );
}

/** The legend: what A is, what A' is. */
function Sides({ shown: { info, record }, name }: { shown: ShownVerification; name: string }) {
  const control =
    info.source === "trace"
      ? t("verify.side.trace", { name: info.trace })
      : t("verify.side.native", { name: record?.instance ?? name });
  const [first] = info.instances;
  const where =
    info.instances.length > 1
      ? t("verify.instances", { count: info.instances.length })
      : first && first !== info.title
        ? first
        : "";
  return (
    <>
      {where && (
        <span className="mono" title={info.instances.join("\n")}>
          {where}
          {", "}
        </span>
      )}
      {control}, {t("verify.side.reference")}
      {record && `, ${t("verify.record.of", { by: record.by, version: record.program_version })}`}
    </>
  );
}

function Controls({ info }: { info: ShownVerification["info"] }) {
  const forbidden = useForbidden("travel");
  const live = info.source === "live";
  const going = isGoing(info);
  const paced = info.pace !== "free";
  return (
    <>
      <span className="label vflabel">{t("verify.memory")}</span>
      <Segments
        label={t("verify.memory")}
        value={info.memory}
        options={[
          { value: "recorded", word: t("verify.recorded"), icon: "record", title: t("verify.recorded.about") },
          { value: "set", word: t("verify.set"), title: t("verify.set.about") },
        ]}
        onChoose={(memory) => void drive({ memory })}
      />
      <span className="label vflabel">{t("verify.pace")}</span>
      <Segments
        label={t("verify.pace")}
        value={info.pace}
        disabled={live ? forbidden : null}
        options={(["free", "scan", "step"] as const).map((pace) => ({
          value: pace,
          word: t(`verify.pace.${pace}`),
          title: t(`verify.pace.${pace}.about`),
        }))}
        onChoose={(pace) => void drive({ pace })}
      />
      {paced && (
        <>
          <Switch on={info.auto} onToggle={() => void drive({ auto: !info.auto })}>
            <span title={t("verify.auto.about")}>{t("verify.auto")}</span>
          </Switch>
          <button
            type="button"
            className="btn sm"
            disabled={!going || info.auto}
            title={t(info.pace === "scan" ? "verify.go.scan" : "verify.go.step")}
            onClick={() => {
              selectNewest();
              void drive({ action: "go_on" });
            }}
          >
            <Icon name={info.pace === "scan" ? "scan" : "step-over"} small />
            {t("verify.go")}
          </button>
        </>
      )}
      {going ? (
        <button type="button" className="btn sm" onClick={() => void drive({ action: "stop" })}>
          <Icon name="pause" small />
          {t("verify.stop")}
        </button>
      ) : (
        (info.state === "stopped" || info.state === "failed") && (
          <button type="button" className="btn sm" onClick={() => void drive({ action: "resume" })}>
            <Icon name="play" small />
            {t("verify.resume")}
          </button>
        )
      )}
    </>
  );
}

/** `from scan 1 200`, or the range of scans. */
export function spanOf({ first, last }: ShownVerification["info"]): string {
  return last === null
    ? t("verify.from", { first: grouped(first) })
    : t("verify.span", { first: grouped(first), last: grouped(last) });
}
