import { expect, type Locator, type Page } from '@playwright/test';
import type { Server } from '../fixtures/server';
import { toFront } from './tabs';

/** The editor of one file, with Save and Build. */
export class Editor {
  constructor(
    private readonly page: Page,
    private readonly file: string,
  ) {}

  get region(): Locator {
    return this.page.getByRole('region', { name: `Editor, ${this.file}`, exact: true });
  }

  get tab(): Locator {
    return this.page.getByRole('tab', { name: new RegExp(`^${this.file}`) });
  }

  get text(): Locator {
    return this.region.getByRole('textbox', { name: `Editor, ${this.file}` }).first();
  }

  get squiggles(): Locator {
    return this.region.locator('.squiggly-error');
  }

  get outcome(): Locator {
    return this.region.getByRole('status');
  }

  /** The visible line that contains a text. Monaco draws blanks as non-breaking ones. */
  line(part: string): Locator {
    const pattern = part
      .split(' ')
      .map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'))
      .join('[\\s\\u00a0]+');
    return this.region.locator('.view-line').filter({ hasText: new RegExp(pattern) });
  }

  /** Chooses an entry of a line's menu. Monaco ignores clicks in the first 100 ms of its menu, because they may be accidental. */
  async fromMenu(part: string, item: string): Promise<void> {
    await this.line(part).first().click({ button: 'right' });
    const found = this.page.getByRole('menuitem', { name: item });
    await expect(found).toBeVisible();
    await expect(async () => {
      if (await found.isVisible()) await found.click({ timeout: 2_000 });
      await expect(found).toBeHidden({ timeout: 2_000 });
    }).toPass();
  }

  /** The note above a text that ran in the past: which version it is. */
  get pastNote(): Locator {
    return this.region.getByRole('status').filter({ hasText: 'Program version' });
  }

  /** The live values of a name at the ends of the lines that mention it. */
  inlineValue(name: string): Locator {
    return this.region
      .locator('.inlinerow > span')
      .filter({ hasText: new RegExp(`^${name}`) })
      .locator('b')
      .first();
  }

  /** The values of a name in the colour of a force. */
  forcedValue(name: string): Locator {
    return this.region.locator('.inlinerow > .forced').filter({ hasText: new RegExp(`^${name}`) });
  }

  /** Whether the values of a name are shown after the ends of the lines that mention it, each in its own line. */
  async valuesAreBeside(name: string): Promise<boolean> {
    return this.region.evaluate((region, wanted) => {
      const lines = [...region.querySelectorAll('.view-line')].map((line) => ({
        text: line.textContent ?? '',
        top: line.getBoundingClientRect().top,
        end: line.firstElementChild?.getBoundingClientRect().right ?? 0,
      }));
      const rows = [...region.querySelectorAll<HTMLElement>('.inlinerow')].filter(
        (row) => !row.hidden && row.firstChild?.textContent?.startsWith(wanted),
      );
      const beside = (row: HTMLElement) => {
        const { top, left } = row.getBoundingClientRect();
        return lines.some((line) => Math.abs(line.top - top) < 2 && line.end <= left && line.text.includes(wanted));
      };
      return rows.length > 0 && rows.every(beside);
    }, name);
  }

  get conflict(): Locator {
    return this.region.getByRole('region', { name: 'Save conflict' });
  }

  async open(): Promise<void> {
    await toFront(this.tab);
    await expect(this.text).toBeAttached();
  }

  /** Turns the wheel until a line is clear of the edges; lines that are not visible are not in the page at all. */
  async reveal(part: string): Promise<void> {
    const line = this.line(part).first();
    const area = await this.region
      .locator('.view-lines')
      .locator('xpath=ancestor::*[contains(@class, "overflow-guard")][1]')
      .boundingBox();
    if (!area) throw new Error('the editor is not to be seen');
    await this.page.mouse.move(area.x + area.width / 2, area.y + area.height / 2);
    const offset = async () => {
      const box = (await line.count()) > 0 ? await line.boundingBox() : null;
      if (!box) return null;
      // The first lines are covered by those of the sections around them.
      const widget = this.region.locator('.sticky-widget').first();
      const sticky = (await widget.count()) > 0 ? ((await widget.boundingBox())?.height ?? 0) : 0;
      if (box.y < area.y + sticky) return -1;
      return box.y + box.height > area.y + area.height - 10 ? 1 : 0;
    };
    // In sight twice in a row: the page may be scrolling by itself.
    for (let turn = 0, still = 0, seen = await offset(); turn < 60 && still < 2; turn += 1) {
      // The line is not in the page: search from the top downward.
      if (seen !== 0) await this.page.mouse.wheel(0, seen === null && turn === 0 ? -100_000 : 40 * (seen ?? 1));
      await this.page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
      seen = await offset();
      still = seen === 0 ? still + 1 : 0;
    }
  }

  async caretAfter(part: string): Promise<void> {
    await expect(this.region.locator('.view-line').first()).toBeVisible();
    // The lines of the sections above are drawn later than the text, and may cover the line by then.
    await expect(async () => {
      await this.reveal(part);
      await this.line(part).first().click({ timeout: 2_000 });
    }).toPass();
    await this.page.keyboard.press('End');
  }

  async type(text: string): Promise<void> {
    await this.page.keyboard.type(text);
  }

  /** Adds a line below an existing one; pasted, so that no completion interferes. */
  async addBelow(part: string, text: string): Promise<void> {
    await this.caretAfter(part);
    await this.page.keyboard.insertText(`\n${text}`);
  }

  /** Replaces the whole text, as by pasting. */
  async replaceWith(text: string): Promise<void> {
    await this.text.focus();
    await this.page.keyboard.press('Control+A');
    await this.page.keyboard.insertText(text);
  }

  get saveButton(): Locator {
    return this.region.getByRole('button', { name: 'Save', exact: true });
  }

  get buildButton(): Locator {
    return this.region.getByRole('button', { name: 'Build', exact: true });
  }

  /** The note above the text that its file was deleted. */
  get note(): Locator {
    return this.region.getByRole('status').filter({ hasText: 'deleted' });
  }

  async save(): Promise<void> {
    await this.saveButton.click();
  }

  /** The list of completions, while it is open. */
  get suggestions(): Locator {
    return this.page.locator('.suggest-widget.visible');
  }

  /** Saves, and returns the text that the server has then. */
  async stored(server: Server): Promise<string> {
    await this.save();
    await expect(this.saveButton).toBeDisabled();
    return (await server.get<{ text: string }>(`/projects/${server.project}/files/${this.file}`)).text;
  }

  async build(): Promise<void> {
    await this.buildButton.click();
  }
}
