import { type MouseEvent, useEffect, useRef } from "react";
import { CONTENTS, placeOf } from "../../logic/page/help";
import { goInTrail, goTo, searchHelp, useHelp } from "../../store/page/help";
import { showKeys } from "../../store/page/palette";
import { openTour } from "../../store/page/tour";
import { language, t } from "../../text";
import { Icon } from "../../ui/Icon";
import { IconButton } from "../../ui/IconButton";
import { around, isThere, pages, partsOf, search } from "./pages";
import "./help.css";

export default function HelpView() {
  const { trail, at, search: looked } = useHelp();
  const wanted = trail[at] ?? [];
  const place = wanted.find(isThere) ?? CONTENTS;
  return (
    <>
      <div className="sub helpbar">
        <IconButton icon="back" label={t("help.back")} small disabled={at === 0} onClick={() => goInTrail(-1)} />
        <IconButton
          icon="forward"
          label={t("help.forward")}
          small
          disabled={at === trail.length - 1}
          onClick={() => goInTrail(1)}
        />
        <IconButton icon="list" label={t("help.contents")} small onClick={() => goTo([CONTENTS])} />
        <span className="inp sm filter grow">
          <Icon name="search" small />
          <input
            type="search"
            value={looked}
            placeholder={t("help.search")}
            aria-label={t("help.search")}
            spellCheck={false}
            onChange={(event) => searchHelp(event.target.value)}
          />
        </span>
        <button type="button" className="btn quiet sm" onClick={openTour}>
          {t("tour.title")}
        </button>
        <button type="button" className="btn quiet sm" onClick={() => showKeys(true)}>
          {t("help.keys")}
        </button>
      </div>
      {language() !== "en" && (
        <p className="sub helpnote" role="note">
          <Icon name="info" small />
          {t("help.english")}
        </p>
      )}
      {looked.trim() === "" ? <Article place={place} turn={at} /> : <Results text={looked} />}
    </>
  );
}

/** A page, with the wanted place in sight. `turn` tells visits of the same place apart. */
function Article({ place, turn }: { place: string; turn: number }) {
  const article = useRef<HTMLElement>(null);
  const { path, id } = partsOf(place);
  const page = pages.get(path);
  // biome-ignore lint/correctness/useExhaustiveDependencies: the same place may be asked for again
  useEffect(() => {
    const element = article.current;
    if (!element) return;
    for (const before of element.querySelectorAll(".here")) before.classList.remove("here");
    const there = id === "" ? null : element.querySelector(`#${CSS.escape(id)}`);
    there?.classList.add("here");
    if (there) there.scrollIntoView({ block: "start" });
    else element.scrollTop = 0;
  }, [path, id, turn]);

  function onClick(event: MouseEvent): void {
    const link = event.target instanceof Element ? event.target.closest("a") : null;
    const href = link?.getAttribute("href");
    if (!href) return;
    event.preventDefault();
    const to = placeOf(href, path);
    if (to === null) window.open(href, "_blank", "noopener");
    else goTo([to]);
  }

  return (
    <article
      ref={article}
      className="help scroll"
      lang="en"
      aria-label={page?.title}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
      onClick={onClick}
      // biome-ignore lint/security/noDangerouslySetInnerHtml: made from our own files when the page is built; HTML in them stays text
      dangerouslySetInnerHTML={{ __html: page?.html ?? "" }}
    />
  );
}

function Results({ text }: { text: string }) {
  const found = search(text);
  if (found.length === 0) return <p className="lonely faint">{t("help.nothing", { text: text.trim() })}</p>;
  return (
    <ul className="scroll helpfound" aria-label={t("help.found")} lang="en">
      {found.map(({ path, id, title, page, text: body }) => (
        <li key={`${path}#${id}`}>
          <button type="button" onClick={() => goTo([`${path}#${id}`])}>
            <b>{title}</b>
            {page !== title && <span className="faint"> {page}</span>}
            <span className="cut muted">{around(body, text)}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}
