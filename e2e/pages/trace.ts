import { readFile } from 'node:fs/promises';
import { expect, type Locator, type Page } from '@playwright/test';
import { toFront } from './tabs';

/** The trace: signals over scans, recorded in the PLC. */
export class Trace {
  constructor(private readonly page: Page) {}

  get pane(): Locator {
    return this.page.locator('[data-pane="trace"]');
  }

  async show(): Promise<void> {
    await toFront(this.page.getByRole('tab', { name: 'Trace', exact: true }));
    await expect(this.pane).toBeVisible();
  }

  /** Values at the cursors: the content of the plots as text. */
  get table(): Locator {
    return this.page.getByRole('grid', { name: 'Values at the cursors' });
  }

  row(signal: string): Locator {
    return this.table.getByRole('row').and(this.page.locator(`[data-signal="${signal}"]`));
  }

  /** Armed, Triggered, Complete, Recording, Stopped. */
  get state(): Locator {
    return this.pane.locator('[data-state]');
  }

  cursor(name: 'A' | 'B'): Locator {
    return this.page.getByRole('slider', { name: `Cursor ${name}` });
  }

  field(name: string): Locator {
    return this.pane.getByLabel(name, { exact: true });
  }

  async add(signal: string): Promise<void> {
    const box = this.page.getByRole('combobox', { name: 'Signal to record' });
    await box.fill(signal);
    await box.press('Enter');
    await expect(this.row(signal)).toBeVisible();
  }

  /** Arms the trigger. */
  async arm(signal: string, when: string): Promise<void> {
    await this.pane.getByRole('combobox', { name: 'Trigger condition' }).selectOption(when);
    await this.enter('When', signal);
    await expect(this.state).toHaveText('Armed');
  }

  async enter(name: string, value: string): Promise<void> {
    await this.field(name).fill(value);
    await this.field(name).press('Enter');
  }

  async choose(menu: string, item: string | RegExp): Promise<void> {
    await this.pane.getByRole('button', { name: menu }).click();
    await this.page.getByRole('menu', { name: menu }).getByText(item).click();
  }

  /** What is exported, line by line. */
  async csv(): Promise<string[][]> {
    const [download] = await Promise.all([
      this.page.waitForEvent('download'),
      this.choose('Export', 'CSV of all samples'),
    ]);
    const text = await readFile(await download.path(), 'utf8');
    return text
      .trim()
      .split('\r\n')
      .map((line) => line.split(','));
  }

  /** The scan of a cursor, as screen readers announce it. */
  async scanOf(name: 'A' | 'B'): Promise<number> {
    return Number(await this.cursor(name).getAttribute('aria-valuenow'));
  }

  /** Clicks into the plots, at a fraction of their width. */
  async clickAt(share: number): Promise<void> {
    const box = await this.pane.locator('.trstack').boundingBox();
    if (!box) throw new Error('no plots');
    await this.page.mouse.click(box.x + 50 + (box.width - 170) * share, box.y + 40);
  }

  /** The number of colours in the drawing: more than one if something is drawn. */
  async inks(): Promise<number> {
    return this.pane
      .locator('.truplot canvas')
      .first()
      .evaluate((canvas: HTMLCanvasElement) => {
        const context = canvas.getContext('2d');
        const { data } = context?.getImageData(0, 0, canvas.width, canvas.height) ?? { data: new Uint8ClampedArray() };
        let inked = 0;
        for (let at = 3; at < data.length; at += 4) if ((data[at] ?? 0) > 128) inked += 1;
        return inked;
      });
  }
}
