import { useEffect, useState } from "react";
import { showHelp } from "../../store/page/help";
import { endTour, goToStep, leaveTour, useTour } from "../../store/page/tour";
import { watch } from "../../store/plc/watches";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";
import { IconButton } from "../../ui/IconButton";
import { STEPS, type Step, WATCHED } from "./steps";
import "./tour.css";

/** How often the page is looked at, in ms: for what happened, and for where the control is now. */
const LOOK = 200;

/** A line above the work, which covers nothing: every step can be done, skipped, or left for later. */
export default function Tour() {
  const { at } = useTour();
  useEffect(() => watch(WATCHED), []);
  const step = STEPS[at];
  return (
    <section className="tour" aria-label={t("tour.title")} data-pane="tour">
      <b>{t("tour.title")}</b>
      <span className="faint">{t("tour.step", { at: Math.min(at + 1, STEPS.length), of: STEPS.length })}</span>
      {step ? <Doing key={step.name} step={step} at={at} /> : <End />}
      <IconButton icon="x" label={t("tour.leave")} small onClick={leaveTour} />
    </section>
  );
}

function Doing({ step, at }: { step: Step; at: number }) {
  const [before] = useState(() => step.before?.() ?? 0);
  const [done, setDone] = useState(false);
  const [place, setPlace] = useState<DOMRect | null>(null);
  useEffect(() => step.show(), [step]);
  useEffect(() => {
    const look = () => {
      setDone((was) => (was && step.lasts !== true) || step.done(before));
      setPlace((was) => (samePlace(was, placeOf(step)) ? was : placeOf(step)));
    };
    look();
    const timer = setInterval(look, LOOK);
    return () => clearInterval(timer);
  }, [step, before]);
  return (
    <>
      {!done && place && <Ring place={place} />}
      <p className="grow" aria-live="polite">
        {done ? (
          <>
            <span className="st running">
              <Icon name="check" small />
            </span>{" "}
            {t(`tour.${step.name}.done`)}
          </>
        ) : (
          t(`tour.${step.name}`)
        )}
      </p>
      <span className="acts">
        <button type="button" className="btn quiet sm" disabled={at === 0} onClick={() => goToStep(at - 1)}>
          {t("tour.before")}
        </button>
        {!done && (
          <button type="button" className="btn quiet sm" onClick={step.show}>
            {t("tour.show")}
          </button>
        )}
        <button type="button" className={`btn sm${done ? " primary" : ""}`} onClick={() => goToStep(at + 1)}>
          {t(done ? "tour.next" : "tour.skip")}
        </button>
      </span>
    </>
  );
}

function placeOf(step: Step): DOMRect | null {
  const place = step.target()?.getBoundingClientRect();
  return place && place.width > 0 && place.height > 0 ? place : null;
}

const samePlace = (one: DOMRect | null, other: DOMRect | null) =>
  one === other ||
  (one !== null &&
    other !== null &&
    one.x === other.x &&
    one.y === other.y &&
    one.width === other.width &&
    one.height === other.height);

/** Points at a control; clicks go through it. */
function Ring({ place }: { place: DOMRect }) {
  const { left, top, width, height } = place;
  return (
    <div
      className="tourring"
      aria-hidden="true"
      style={{ left: left - 4, top: top - 4, width: width + 8, height: height + 8 }}
    />
  );
}

function End() {
  return (
    <>
      <p className="grow">{t("tour.end")}</p>
      <span className="acts">
        <button type="button" className="btn quiet sm" onClick={() => goToStep(0)}>
          {t("tour.again")}
        </button>
        <button type="button" className="btn sm" onClick={() => showHelp("README.md")}>
          {t("help.title")}
        </button>
        <button type="button" className="btn primary sm" onClick={endTour}>
          {t("tour.close")}
        </button>
      </span>
    </>
  );
}
