import { expect, type Locator, type Page } from '@playwright/test';

/** The run along the bottom edge: every scan, the commands, and going back. */
export class Timeline {
  constructor(private readonly page: Page) {}

  get region(): Locator {
    return this.page.getByRole('region', { name: 'Timeline' });
  }

  /** The axis itself, which takes clicks and keys. */
  get axis(): Locator {
    return this.region.getByRole('slider', { name: 'Timeline' });
  }

  /** The banner that says which scan is shown, and how to continue. */
  get banner(): Locator {
    return this.page.getByRole('region', { name: 'In the past' });
  }

  mark(text: string | RegExp): Locator {
    return this.region.getByRole('list', { name: 'Marks' }).getByRole('button', { name: text });
  }

  /** The scan that is shown. */
  async position(): Promise<number> {
    return Number(await this.axis.getAttribute('aria-valuenow'));
  }

  /** Wants to go to a scan; with others at the PLC the page asks first. */
  async want(scan: number): Promise<void> {
    const box = this.region.getByRole('textbox', { name: 'Go to scan' });
    await box.fill(String(scan));
    await box.press('Enter');
  }

  async goTo(scan: number): Promise<void> {
    await this.want(scan);
    await expect(this.banner).toBeVisible();
    await expect.poll(() => this.position()).toBe(scan);
  }

  /** Clicks a place of the axis: 0 is its left end, 1 its right one. */
  async click(share: number): Promise<void> {
    const box = await this.axis.boundingBox();
    if (!box) throw new Error('the timeline is not to be seen');
    await this.page.mouse.click(box.x + 8 + (box.width - 16) * share, box.y + box.height * 0.75);
  }

  async returnToLive(): Promise<void> {
    await this.banner.getByRole('button', { name: 'Return to live' }).click();
    await expect(this.banner).toBeHidden();
  }

  /** A new instance that begins at the scan shown; the page goes there. */
  async branch(name: string): Promise<void> {
    await this.banner.getByRole('button', { name: 'Branch from here' }).click();
    const dialog = this.page.getByRole('dialog', { name: /^Branch from / });
    await dialog.getByRole('textbox', { name: 'Name' }).fill(name);
    await dialog.getByRole('button', { name: 'Create' }).click();
    await expect(dialog).toBeHidden();
  }
}
